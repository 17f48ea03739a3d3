#include "checksum.hpp"

#include <skein/core/error.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/io/read_file.hpp>

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <new>

namespace skein {
namespace {

constexpr std::string_view seal_magic = "SKEINSUM";

}  // namespace

Checksum::Checksum() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state_);
}

Checksum::~Checksum() { XXH3_freeState(state_); }

void Checksum::add(const void* bytes, const std::size_t n_bytes) { XXH3_64bits_update(state_, bytes, n_bytes); }

std::string Checksum::text() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_)); }

std::string make_seal(const std::string_view bytes) { return std::string(seal_magic) + compute_seal(bytes); }

void check_seal(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const auto fail = [](const std::string& what) { throw Error(ExitCode::damaged_data, what); };
  constexpr std::size_t seal_size = seal_magic.size() + 16;
  const std::size_t n_content = bytes.size() < seal_size ? 0 : bytes.size() - seal_size;
  if (bytes.size() < seal_size || std::string_view(bytes).substr(n_content, seal_magic.size()) != seal_magic)
    fail(fmt::format("'{}' is cut off: its last bytes, {} of {}, are no checksum.", path.string(),
                     std::min(seal_size, bytes.size()), bytes.size()));
  if (std::string_view(bytes).substr(n_content) != make_seal(std::string_view(bytes).substr(0, n_content)))
    fail(fmt::format("'{}' was changed: its checksum does not fit its {} bytes.", path.string(), bytes.size()));
}

}  // namespace skein
