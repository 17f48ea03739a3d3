#include "hdf5_reader.hpp"

#include <skein/core/error.hpp>

#include <fmt/format.h>

namespace skein {

Hdf5Reader::Hdf5Reader(std::filesystem::path path)
    : path_(std::move(path)), file_(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
  if (!file_.valid()) fail("/");
}

void Hdf5Reader::fail(const std::string& object) const {
  throw Error(ExitCode::damaged_data,
              fmt::format("cannot read '{}' in '{}': {}.", object, path_.string(), hdf5_reason()));
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const std::string whole_name = object + "@" + name;
  const Hdf5Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!attribute.valid()) fail(whole_name);
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
  if (!type.valid() || H5Tis_variable_str(type.id()) <= 0) fail(whole_name);
  char* text = nullptr;
  if (H5Aread(attribute.id(), type.id(), &text) < 0 || text == nullptr) fail(whole_name);
  std::string result(text);
  H5free_memory(text);
  return result;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) const {
  const std::string whole_name = object + "@" + name;
  const Hdf5Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!attribute.valid()) fail(whole_name);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  std::int64_t value = 0;
  if (!space.valid() || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), H5T_NATIVE_INT64, &value) < 0)
    fail(whole_name);
  return value;
}

std::vector<std::byte> Hdf5Reader::read_raw(const std::string& dataset, const Number number) const {
  const Hdf5Handle source(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!source.valid()) fail(dataset);
  const Hdf5Handle space(H5Dget_space(source.id()), H5Sclose);
  const Hdf5Handle type(H5Dget_type(source.id()), H5Tclose);
  const hssize_t n_values = space.valid() ? H5Sget_simple_extent_npoints(space.id()) : -1;
  hsize_t n_file_bytes = 0;
  if (n_values < 0 || !type.valid() || H5Tequal(type.id(), type_in_file(number)) <= 0 ||
      H5Fget_filesize(file_.id(), &n_file_bytes) < 0 || static_cast<hsize_t>(n_values) > n_file_bytes)
    fail(dataset);
  std::vector<std::byte> values(static_cast<std::size_t>(n_values) * size_of(number));
  if (n_values > 0 && H5Dread(source.id(), type_in_memory(number), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(dataset);
  return values;
}

template <class Value>
std::vector<Value> Hdf5Reader::read(const std::string& dataset, const hid_t type) const {
  const Hdf5Handle source(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!source.valid()) fail(dataset);
  const Hdf5Handle space(H5Dget_space(source.id()), H5Sclose);
  const hssize_t n_values = space.valid() ? H5Sget_simple_extent_npoints(space.id()) : -1;
  hsize_t n_file_bytes = 0;
  // A damaged extent must not ask for more memory than the file could fill.
  if (n_values < 0 || H5Fget_filesize(file_.id(), &n_file_bytes) < 0 || static_cast<hsize_t>(n_values) > n_file_bytes)
    fail(dataset);
  std::vector<Value> values(static_cast<std::size_t>(n_values));
  if (n_values > 0 && H5Dread(source.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) fail(dataset);
  return values;
}

std::vector<std::int64_t> Hdf5Reader::read_integers(const std::string& dataset) const {
  return read<std::int64_t>(dataset, H5T_NATIVE_INT64);
}

std::vector<double> Hdf5Reader::read_reals(const std::string& dataset) const {
  return read<double>(dataset, H5T_NATIVE_DOUBLE);
}

}  // namespace skein
