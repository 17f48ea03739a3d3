#pragma once

#include <skein/arrays/types.hpp>

namespace skein {

/// Point forces on the fluid, each spread over its own blob.
struct Sources {
  ConstVectors position;  ///< [n_sources, 3], length
  ConstVectors force;     ///< [n_sources, 3], force exerted BY the node ON the fluid
  ConstScalars blob;      ///< [n_sources], regularization length, > 0
  /// Nothing has changed positions and forces since Physics computed the forces: ranks that share sums may have them.
  bool are_shared = false;
};

}  // namespace skein
