#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace skein {

/// Named numbers and texts from which a run goes on: lists of doubles, lists of integers, and texts.
class Checkpoint {
 public:
  using Value = std::variant<std::vector<double>, std::vector<std::int64_t>, std::string>;

  void set(const std::string& name, Value value) { values_[name] = std::move(value); }
  bool has(const std::string& name) const { return values_.count(name) > 0; }
  const std::map<std::string, Value>& values() const { return values_; }

  /// @throws Error(damaged_data) naming the value if it is absent, of another kind, or no single number
  const std::vector<double>& numbers(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  double number(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;

 private:
  std::map<std::string, Value> values_;
};

/// With what every checkpoint file begins.
inline constexpr std::string_view checkpoint_magic = "\x89SKEIN\r\n";

/// The bytes of a checkpoint file; see src/io/checkpoint.cpp for their order.
std::string encode_checkpoint(const Checkpoint& checkpoint);

/// @throws Error(damaged_data), saying what is wrong, for anything but the bytes of encode_checkpoint()
Checkpoint decode_checkpoint(std::string_view bytes);

/// The last 16 bytes of a checkpoint file: XXH3, 128 bits, of all bytes before.
std::string compute_seal(std::string_view bytes);

/// @throws Error(damaged_data) naming the file and what is wrong with it
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace skein
