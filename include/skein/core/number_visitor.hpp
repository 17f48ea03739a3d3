#pragma once

#include <cstdint>
#include <string_view>

namespace skein {

/// Sees, by name, every number that an object's next step depends on. What saves and what restores are visitors, so
/// that an object lists its memory once. Objects that remember arrays, too, are shown a MemoryVisitor.
class NumberVisitor {
 public:
  virtual ~NumberVisitor() = default;

  virtual void number(std::string_view name, double& value) = 0;
  virtual void integer(std::string_view name, std::int64_t& value) = 0;

  /// Smaller integers and truth values.
  template <class Integer>
  void count(const std::string_view name, Integer& value) {
    auto wide = static_cast<std::int64_t>(value);
    integer(name, wide);
    value = static_cast<Integer>(wide);
  }
};

}  // namespace skein
