#include "checksum.hpp"

#include <new>

#include <fmt/format.h>
#include <xxhash.h>

namespace skein {

Checksum::Checksum() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state_);
}

Checksum::~Checksum() { XXH3_freeState(state_); }

void Checksum::add(const void* bytes, const std::size_t n_bytes) { XXH3_64bits_update(state_, bytes, n_bytes); }

std::string Checksum::text() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_)); }

}  // namespace skein
