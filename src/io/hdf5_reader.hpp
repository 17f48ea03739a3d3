#pragma once

#include "plain_dataset.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// Whether a dataset may hold numbers that are not finite.
enum class Values { finite, any };

/// An HDF5 file open for reading, in which nothing is believed: a seal can be computed by anybody.
///
/// What is read is what this program writes, and nothing else: see PlainDataset; and attributes of one number or one
/// text. Links other than hard ones are not followed, so that a crafted file cannot make the program read others.
///
/// @throws Error(damaged_data) from every function, naming the file, the object and what is wrong with it;
///         Error(io_error) where the system does not give what the file holds
class Hdf5Reader {
 public:
  /// @param check_seal  read all of the file first, and open it only if it is as it was written
  explicit Hdf5Reader(std::filesystem::path path, bool check_seal = true);

  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;

  /// Of 8 bytes each. @param shape  what the dataset must have, with any_extent where that is open
  std::vector<std::int64_t> read_integers(const std::string& dataset, const Shape& shape) const;
  /// Of 4 or 8 bytes each.
  std::vector<double> read_reals(const std::string& dataset, const Shape& shape, Values allowed = Values::finite) const;
  /// The numbers as they are stored, in this machine's byte order. The dataset must hold that kind of number.
  std::vector<std::byte> read_raw(const std::string& dataset, Number number, const Shape& shape) const;

  /// Throws for an object whose content was found wrong. @param why  completes "because ..."
  [[noreturn]] void reject(const std::string& object, const std::string& why) const;

 private:
  struct OpenDataset {
    Hdf5Handle id;
    PlainDataset content;
  };

  [[noreturn]] void fail(const std::string& object) const;
  Hdf5Handle open(const std::string& object) const;
  Hdf5Handle open_attribute(const std::string& object, const std::string& name) const;
  OpenDataset open_dataset(const std::string& dataset, const Shape& shape) const;
  void read_into(const OpenDataset& source, const std::string& dataset, hid_t type, void* values) const;

  QuietHdf5 quiet_;
  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace skein
