#include <skein/core/error.hpp>
#include <skein/io/array_file.hpp>
#include <skein/io/csv_file.hpp>

#include "hdf5_reader.hpp"
#include "hdf5_writer.hpp"

#include <fmt/format.h>

namespace skein {

void write_array_file(const std::filesystem::path& path, const std::vector<NamedArray>& arrays,
                      const std::vector<std::pair<std::string, std::string>>& attributes) {
  constexpr std::size_t growth = 1 << 20;
  Hdf5Writer file(path, growth);
  for (const NamedArray& array : arrays) {
    const Shape shape(array.shape.begin(), array.shape.end());
    std::size_t n = 1;
    for (const std::size_t extent : array.shape) n *= extent;
    SKEIN_REQUIRE(n == array.values.size(), fmt::format("'{}' has as many numbers as its shape says", array.name));
    file.write("/" + array.name, Number::float64, shape, array.values.data(), array.unit);
  }
  for (const auto& [name, text] : attributes) file.set_attribute("/", name, text);
  file.commit();
}

std::vector<double> read_array(const std::filesystem::path& path, const std::string& name) {
  return Hdf5Reader(path).read_reals("/" + name, {any_extent}, Values::any);
}

std::string read_array_attribute(const std::filesystem::path& path, const std::string& name) {
  return Hdf5Reader(path).text_attribute("/", name);
}

void write_csv(const std::filesystem::path& path, const std::vector<NamedArray>& columns) {
  SKEIN_REQUIRE(!columns.empty(), "a table has columns");
  std::vector<CsvRow> rows(1 + columns.front().values.size());
  for (const NamedArray& column : columns) {
    SKEIN_REQUIRE(column.values.size() + 1 == rows.size(), "columns have one length");
    rows[0].push_back(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
    for (std::size_t i = 0; i < column.values.size(); ++i) rows[i + 1].push_back(fmt::format("{}", column.values[i]));
  }
  write_csv_rows(path, rows);
}

}  // namespace skein
