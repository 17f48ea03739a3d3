#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace skein {

/// A file that takes its name only once it is whole and on disk: it is written beside it as `<name>.partial`, synced,
/// renamed, and its folder synced. Until then an older file of that name stays as it was.
///
/// @throws Error(io_error) from every function but the destructor, naming the file, the bytes and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();  ///< without commit() nothing remains
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, std::size_t n_bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void commit();

  /// Puts on disk what is written so far; commit() does it, too.
  void sync();

  std::uint64_t bytes_written() const { return bytes_written_; }

 private:
  std::string what_fails() const;

  std::filesystem::path path_;
  std::filesystem::path partial_;
  int descriptor_ = -1;
  std::uint64_t bytes_written_ = 0;
};

/// The whole content at once. @throws Error(io_error)
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace skein
