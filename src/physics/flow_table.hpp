#pragma once

#include <skein/scene/scene_config.hpp>

#include "kernels/flow_term.hpp"

#include <string>

namespace skein {

/// All that is particular to one kind of flow. Its word and the formula that readers of scenes see are in
/// src/scene/words.cpp.
struct FlowRow {
  FlowKind kind;

  /// The flow at one moment; the gradient follows from it, too. Null for fluid at rest. @param rate  r(t), 1 / time
  FlowTerm (*make_term)(const FlowConfig& flow, double rate);

  double deformation;  ///< largest sqrt(2 E : E) over |r|, E the symmetric part of the velocity gradient
  double motion;       ///< over |r|: 1 / the time in which the flow changes what it carries

  /// For the first lines of a run: a format with {r} for the rate, {x}, {y}, {z} for distances from the center, and
  /// {size}.
  const char* velocity;

  std::string describe_velocity(const FlowConfig& flow, const std::string& r) const;
  bool is_at_rest() const { return make_term == nullptr; }
};

/// @throws Error(internal) for a kind without a row
const FlowRow& row_of(FlowKind kind);

}  // namespace skein
