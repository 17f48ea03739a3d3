#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/number_visitor.hpp>

#include <string_view>

namespace skein {

class NodeVectors;

/// Sees arrays, too.
class MemoryVisitor : public NumberVisitor {
 public:
  virtual void vectors(std::string_view name, const Vectors& values) = 0;  ///< their contents

  /// The same of an array of which ranks may have parts: `vectors` sees the whole of it.
  /// @param nodes  that have made it
  virtual void node_vectors(std::string_view name, NodeVectors& nodes, const Vectors& values);

  /// Else it only looks.
  virtual bool changes_what_it_sees() const { return false; }
};

}  // namespace skein
