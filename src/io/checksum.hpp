#pragma once

#include <cstddef>
#include <string>

struct XXH3_state_s;

namespace skein {

/// xxh3, 64 bits, of bytes given piece by piece.
class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(const void* bytes, std::size_t n_bytes);
  void add(const std::string& text) { add(text.data(), text.size()); }

  /// Of all that was added so far, as 16 hexadecimal digits.
  std::string text() const;

 private:
  XXH3_state_s* state_;
};

}  // namespace skein
