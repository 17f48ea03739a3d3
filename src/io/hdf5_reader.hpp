#pragma once

#include "hdf5_handle.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// An HDF5 file open for reading.
/// @throws Error(damaged_data) from every function, naming the file and the object
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::filesystem::path path);

  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::int64_t> read_integers(const std::string& dataset) const;
  std::vector<double> read_reals(const std::string& dataset) const;

  /// The numbers as they are stored, in this machine's byte order. The dataset must hold that kind of number.
  std::vector<std::byte> read_raw(const std::string& dataset, Number number) const;

 private:
  [[noreturn]] void fail(const std::string& object) const;
  template <class Value>
  std::vector<Value> read(const std::string& dataset, hid_t type) const;

  QuietHdf5 quiet_;
  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace skein
