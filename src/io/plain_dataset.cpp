#include "plain_dataset.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

bool fits(const Shape& found, const Shape& expected) {
  bool fits = found.size() == expected.size();
  for (std::size_t i = 0; fits && i < found.size(); ++i) fits = expected[i] == any_extent || found[i] == expected[i];
  return fits;
}

std::string find_extent_fault(const hid_t dataset, const Shape& expected, std::size_t& n_values) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  Shape shape;
  if (!space.valid() || !read_shape(space.id(), shape)) return "it is no array";
  if (!fits(shape, expected))
    return fmt::format("its shape is {} and should be {}", describe_shape(shape), describe_shape(expected));
  n_values = 1;
  for (const hsize_t extent : shape)
    if (__builtin_mul_overflow(n_values, extent, &n_values))
      return fmt::format("no file holds its {} numbers", describe_shape(shape));
  return "";
}

bool find_number(const hid_t dataset, Number& found) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  for (const Number number : {Number::float32, Number::float64, Number::int32, Number::int64}) {
    if (!type.valid() || H5Tequal(type.id(), type_in_file(number)) <= 0) continue;
    found = number;
    return true;
  }
  return false;
}

std::string find_storage_fault(const hid_t file, const hid_t dataset, const PlainDataset& found) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (!creation.valid()) return "nothing says how it is stored";
  if (H5Pget_external_count(creation.id()) != 0) return "its numbers are to come from another file";
  if (H5Pget_layout(creation.id()) != H5D_CONTIGUOUS || H5Pget_nfilters(creation.id()) != 0)
    return "it is not stored in one piece, as it is when it is written";
  if (found.n_values == 0) return "";
  hsize_t n_file_bytes = 0;
  if (H5Fget_filesize(file, &n_file_bytes) < 0) return "the file's size is unknown";
  const std::size_t size = size_of(found.number);
  const haddr_t offset = H5Dget_offset(dataset);
  if (found.n_values > n_file_bytes / size || H5Dget_storage_size(dataset) != found.n_values * size ||
      offset == HADDR_UNDEF || offset > n_file_bytes - found.n_values * size)
    return fmt::format("its {} numbers are not all among the file's {} bytes", found.n_values, n_file_bytes);
  return "";
}

}  // namespace

std::string describe_shape(const Shape& shape) {
  std::string text;
  for (const hsize_t extent : shape)
    text += fmt::format("{}{}", text.empty() ? "" : " x ", extent == any_extent ? "n" : fmt::format("{}", extent));
  return text.empty() ? "that of a single value" : text;
}

bool read_shape(const hid_t space, Shape& shape) {
  const H5S_class_t kind = H5Sget_simple_extent_type(space);
  const int rank = H5Sget_simple_extent_ndims(space);
  if ((kind != H5S_SIMPLE && kind != H5S_SCALAR) || rank < 0) return false;
  shape.resize(static_cast<std::size_t>(rank));
  return rank == 0 || H5Sget_simple_extent_dims(space, shape.data(), nullptr) == rank;
}

std::string find_dataset_fault(const hid_t file, const hid_t object, const Shape& expected, PlainDataset& found) {
  if (H5Iget_type(object) != H5I_DATASET) return "it is no array";
  if (!find_number(object, found.number)) return "its numbers are of a type that is never written";
  const std::string fault = find_extent_fault(object, expected, found.n_values);
  return fault.empty() ? find_storage_fault(file, object, found) : fault;
}

}  // namespace skein
