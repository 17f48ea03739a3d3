#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

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

/// 24 bytes for the end of a file: "SKEINSUM" and XXH3, 128 bits, canonical, of all bytes before. HDF5 ignores what
/// follows its own end, but may crash on a damaged file: whoever is not sure of a file looks at its seal first.
std::string make_seal(std::string_view bytes);

/// Reads all of a sealed file. @throws Error(damaged_data) if it is not as it was written, and as read_file
void check_seal(const std::filesystem::path& path);

}  // namespace skein
