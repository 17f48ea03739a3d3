#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/number_visitor.hpp>

#include <string_view>

namespace skein {

/// Sees arrays, too.
class MemoryVisitor : public NumberVisitor {
 public:
  virtual void vectors(std::string_view name, const Vectors& values) = 0;  ///< their contents
};

}  // namespace skein
