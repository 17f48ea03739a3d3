#include <skein/core/error.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/io/read_file.hpp>

#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <cstring>
#include <utility>

// A checkpoint file, all numbers little-endian, every part filled up with zeros to a multiple of 8 bytes:
//
//   8 bytes    0x89 "SKEIN" 0x0d 0x0a: broken by whatever changes line ends or the eighth bit
//   uint32     version of the format, 1
//   uint32     number of values
//   uint64     size of the file in bytes
//   per value: uint32 kind (0 doubles, 1 int64, 2 text), uint32 bytes of the name, uint64 number of elements or bytes,
//              the name, the elements; in the order of their names
//   16 bytes   XXH3, 128 bits, canonical, of everything before
//
// No number of a damaged file is used before the seal was found right; even so every size is checked.

namespace skein {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are written as numbers lie in memory");

constexpr std::string_view magic = checkpoint_magic;
constexpr std::uint32_t format_version = 1;
constexpr std::size_t header_size = 24, seal_size = 16, unit = 8;

[[noreturn]] void fail(const std::string& what) { throw Error(ExitCode::damaged_data, what); }

template <class Number>
void put(std::string& bytes, const Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put(std::string& bytes, const void* content, const std::size_t n_bytes) {
  if (n_bytes > 0) bytes.append(static_cast<const char*>(content), n_bytes);
  bytes.append((unit - n_bytes % unit) % unit, '\0');
}

class ByteReader {
 public:
  explicit ByteReader(const std::string_view bytes) : left_(bytes) {}

  template <class Number>
  Number take_number() {
    Number number;
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }

  /// n_bytes and the zeros after them.
  std::string_view take_padded(const std::uint64_t n_bytes) {
    const std::string_view content = take(n_bytes);
    take((unit - n_bytes % unit) % unit);
    return content;
  }

  template <class Number>
  std::vector<Number> take_list(const std::uint64_t n_numbers) {
    if (n_numbers > left_.size() / sizeof(Number)) fail("a list is longer than the file");
    const std::string_view bytes = take(n_numbers * sizeof(Number));
    std::vector<Number> list(n_numbers);
    if (n_numbers > 0) std::memcpy(list.data(), bytes.data(), bytes.size());
    return list;
  }

  bool at_end() const { return left_.empty(); }

 private:
  std::string_view take(const std::uint64_t n_bytes) {
    if (n_bytes > left_.size()) fail("it ends in the middle of a value");
    const std::string_view taken = left_.substr(0, n_bytes);
    left_.remove_prefix(n_bytes);
    return taken;
  }

  std::string_view left_;
};

struct ValueWriter {
  std::string& bytes;
  const std::string& name;

  void operator()(const std::vector<double>& list) const { write(0, list.size(), list.data(), 8 * list.size()); }
  void operator()(const std::vector<std::int64_t>& list) const { write(1, list.size(), list.data(), 8 * list.size()); }
  void operator()(const std::string& text) const { write(2, text.size(), text.data(), text.size()); }

  void write(const std::uint32_t kind, const std::uint64_t count, const void* content,
             const std::size_t n_bytes) const {
    put(bytes, kind);
    put(bytes, static_cast<std::uint32_t>(name.size()));
    put(bytes, count);
    put(bytes, name.data(), name.size());
    put(bytes, content, n_bytes);
  }
};

Checkpoint::Value take_value(ByteReader& reader, const std::uint32_t kind, const std::uint64_t count) {
  switch (kind) {
    case 0:
      return reader.take_list<double>(count);
    case 1:
      return reader.take_list<std::int64_t>(count);
    case 2:
      return std::string(reader.take_padded(count));
    default:
      fail(fmt::format("it holds a value of the unknown kind {}", kind));
  }
}

template <class Wanted>
const Wanted& get(const Checkpoint& checkpoint, const std::string& name, const char* kind) {
  const auto found = checkpoint.values().find(name);
  if (found == checkpoint.values().end()) fail(fmt::format("'{}' is missing", name));
  const Wanted* value = std::get_if<Wanted>(&found->second);
  if (value == nullptr) fail(fmt::format("'{}' is not {}", name, kind));
  return *value;
}

}  // namespace

const std::vector<double>& Checkpoint::numbers(const std::string& name) const {
  return get<std::vector<double>>(*this, name, "a list of numbers");
}

const std::string& Checkpoint::text(const std::string& name) const { return get<std::string>(*this, name, "a text"); }

double Checkpoint::number(const std::string& name) const {
  const auto& list = numbers(name);
  if (list.size() != 1) fail(fmt::format("'{}' is not one number but {}", name, list.size()));
  return list.front();
}

std::int64_t Checkpoint::integer(const std::string& name) const {
  const auto& list = get<std::vector<std::int64_t>>(*this, name, "an integer");
  if (list.size() != 1) fail(fmt::format("'{}' is not one integer but {}", name, list.size()));
  return list.front();
}

std::string compute_seal(const std::string_view bytes) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
  return {reinterpret_cast<const char*>(canonical.digest), seal_size};
}

std::string encode_checkpoint(const Checkpoint& checkpoint) {
  std::string bytes(magic);
  put(bytes, format_version);
  put(bytes, static_cast<std::uint32_t>(checkpoint.values().size()));
  put(bytes, std::uint64_t{0});
  for (const auto& [name, value] : checkpoint.values()) std::visit(ValueWriter{bytes, name}, value);
  const std::uint64_t size = bytes.size() + seal_size;
  std::memcpy(bytes.data() + header_size - sizeof size, &size, sizeof size);
  return bytes + compute_seal(bytes);
}

Checkpoint decode_checkpoint(const std::string_view bytes) {
  if (bytes.size() < header_size + seal_size) fail(fmt::format("{} bytes are too few for a checkpoint", bytes.size()));
  if (bytes.substr(0, magic.size()) != magic) fail("it does not begin as a checkpoint does");
  const std::string_view content = bytes.substr(0, bytes.size() - seal_size);
  ByteReader reader(content.substr(magic.size()));
  const auto version = reader.take_number<std::uint32_t>();
  const auto n_values = reader.take_number<std::uint32_t>();
  const auto size = reader.take_number<std::uint64_t>();
  if (size != bytes.size()) fail(fmt::format("it has {} bytes and should have {}", bytes.size(), size));
  if (bytes.substr(content.size()) != compute_seal(content)) fail("its checksum is wrong");
  if (version != format_version)
    fail(fmt::format("its format is {}, and this version of skein reads {}", version, format_version));

  Checkpoint checkpoint;
  for (std::uint32_t i = 0; i < n_values; ++i) {
    const auto kind = reader.take_number<std::uint32_t>();
    const auto name_size = reader.take_number<std::uint32_t>();
    const auto count = reader.take_number<std::uint64_t>();
    const std::string name(reader.take_padded(name_size));
    if (checkpoint.has(name)) fail(fmt::format("it holds '{}' twice", name));
    checkpoint.set(name, take_value(reader, kind, count));
  }
  if (!reader.at_end()) fail("something follows its last value");
  return checkpoint;
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  try {
    return decode_checkpoint(read_file(path));
  } catch (const Error& error) {
    const bool is_read = error.code() == ExitCode::damaged_data;
    throw Error(error.code(), fmt::format("checkpoint '{}' {}: {}", path.string(),
                                          is_read ? "is damaged" : "cannot be read", error.what()));
  }
}

}  // namespace skein
