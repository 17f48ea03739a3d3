// Any bytes are refused as damaged. So are bytes that have been given a right beginning, size and checksum, unless they
// are a checkpoint that survives being encoded and decoded again.

#include <skein/core/error.hpp>
#include <skein/io/checkpoint.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

void decode(const std::string& bytes) {
  skein::Checkpoint checkpoint;
  try {
    checkpoint = skein::decode_checkpoint(bytes);
  } catch (const skein::Error& error) {
    if (error.code() != skein::ExitCode::damaged_data) std::abort();
    return;
  }
  const std::string again = skein::encode_checkpoint(checkpoint);
  if (skein::encode_checkpoint(skein::decode_checkpoint(again)) != again) std::abort();
}

// magic, version 1, [number of values and all after it from the fuzzer], size, seal
std::string repair(const std::string& raw) {
  std::string bytes = skein::encode_checkpoint({});
  bytes.resize(24);
  bytes += raw.size() > 1 ? raw.substr(1) : "";
  const std::uint32_t n_values = raw.empty() ? 0 : static_cast<unsigned char>(raw[0]);
  const std::uint64_t size = bytes.size() + 16;
  std::memcpy(bytes.data() + 12, &n_values, sizeof n_values);
  std::memcpy(bytes.data() + 16, &size, sizeof size);
  return bytes + skein::compute_seal(bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, const std::size_t size) {
  const std::string raw(reinterpret_cast<const char*>(data), size);
  decode(raw);
  decode(repair(raw));
  return 0;
}
