#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace skein {

/// Numbers with a name and a unit ("" where they have none), row-major.
struct NamedArray {
  std::string name;
  std::string unit;
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

/// One HDF5 file of datasets of doubles with attributes `unit`; names may hold groups, "fiber_0/curvature". Attributes
/// are those of the root. The file appears whole or not at all. @throws Error(io_error) naming file and bytes
void write_array_file(const std::filesystem::path& path, const std::vector<NamedArray>& arrays,
                      const std::vector<std::pair<std::string, std::string>>& attributes);

/// One list of numbers of a file that write_array_file has written.
/// @throws Error(damaged_data) if the file, or that list in it, is not as it was written or not there; Error(io_error)
std::vector<double> read_array(const std::filesystem::path& path, const std::string& name);
/// Likewise a text.
std::string read_array_attribute(const std::filesystem::path& path, const std::string& name);

/// A table of columns of one length as comma-separated text: a line of names with units in brackets, then one line per
/// row with all digits; "nan", "inf" and "-inf" as such. @throws Error(io_error)
void write_csv(const std::filesystem::path& path, const std::vector<NamedArray>& columns);

}  // namespace skein
