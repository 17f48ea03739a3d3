#include "hdf5_writer.hpp"

#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>

#include "checksum.hpp"

#include <fmt/format.h>

#include <limits>
#include <memory>

namespace skein {
namespace {

// A file in memory has a name, too, and HDF5 opens and reads what it finds under it: here nothing can be.
constexpr const char* no_file = "/dev/null/skein";

Hdf5Handle open_object(const Hdf5Handle& file, const std::string& name) {
  return {H5Oopen(file.id(), name.c_str(), H5P_DEFAULT), H5Oclose};
}

Hdf5Handle make_space(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

// Variable length: an attribute of fixed length ends at 64 KiB, and a scene may be longer.
Hdf5Handle make_text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  if (H5Tset_size(type.id(), H5T_VARIABLE) < 0 || H5Tset_cset(type.id(), H5T_CSET_UTF8) < 0) type.reset();
  return type;
}

}  // namespace

template <class Result>
Result Hdf5Writer::checked(const Result result, const char* what, const std::string& object) const {
  if (result < 0)
    throw Error(ExitCode::io_error,
                fmt::format("cannot {} '{}' in '{}': {}.", what, object, path_.string(), hdf5_reason()));
  return result;
}

template <class Result>
Hdf5Handle Hdf5Writer::handle(const Result result, const Hdf5Handle::Close close, const char* what,
                              const std::string& object) const {
  return {checked(result, what, object), close};
}

Hdf5Writer::Hdf5Writer(std::filesystem::path path, const std::size_t growth)
    : path_(std::move(path)), file_(-1, H5Fclose), make_groups_(H5Pcreate(H5P_LINK_CREATE), H5Pclose) {
  checked(H5Pset_create_intermediate_group(make_groups_.id(), 1), "prepare", "/");
  const Hdf5Handle access = handle(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare", "/");
  checked(H5Pset_fapl_core(access.id(), growth, /*backing_store=*/false), "prepare", "/");
  file_ = handle(H5Fcreate(no_file, H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "begin", "/");
}

void Hdf5Writer::make_group(const std::string& group) {
  handle(H5Gcreate2(file_.id(), group.c_str(), make_groups_.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "make group",
         group);
}

void Hdf5Writer::write(const std::string& dataset, const Number number, const Shape& shape, const void* values,
                       const std::string& unit) {
  std::size_t n_bytes = size_of(number);
  for (const hsize_t extent : shape) n_bytes *= extent;
  const std::string what = fmt::format("write {} bytes of", n_bytes);
  const Hdf5Handle space = make_space(shape);
  checked(space.id(), what.c_str(), dataset);
  const Hdf5Handle creation = make_creation(dataset);
  const Hdf5Handle target = handle(H5Dcreate2(file_.id(), dataset.c_str(), type_in_file(number), space.id(),
                                              make_groups_.id(), creation.id(), H5P_DEFAULT),
                                   H5Dclose, what.c_str(), dataset);
  if (n_bytes > 0)
    checked(H5Dwrite(target.id(), type_in_memory(number), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), what.c_str(),
            dataset);
  if (!unit.empty()) set_attribute(dataset, "unit", unit);
}

// Without the time at which it was written: files of one content are equal.
Hdf5Handle Hdf5Writer::make_creation(const std::string& dataset) const {
  Hdf5Handle creation = handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "prepare", dataset);
  checked(H5Pset_obj_track_times(creation.id(), false), "prepare", dataset);
  return creation;
}

Hdf5Handle Hdf5Writer::make_virtual_creation(const Number number, const std::string& dataset) const {
  Hdf5Handle creation = make_creation(dataset);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::int64_t no_count = -1;
  if (number == Number::float32 || number == Number::float64)
    checked(H5Pset_fill_value(creation.id(), H5T_NATIVE_DOUBLE, &nothing), "prepare", dataset);
  else
    checked(H5Pset_fill_value(creation.id(), H5T_NATIVE_INT64, &no_count), "prepare", dataset);
  return creation;
}

void Hdf5Writer::write_virtual(const std::string& dataset, const Number number, const Shape& row_shape,
                               const std::vector<Source>& sources, const std::string& unit) {
  Shape shape(1, 0);
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  for (const Source& source : sources) shape[0] += source.n_rows;
  if (shape[0] == 0) return write(dataset, number, shape, nullptr, unit);

  const Hdf5Handle space = make_space(shape);
  const Hdf5Handle creation = make_virtual_creation(number, dataset);
  Shape first(shape.size(), 0);
  Shape count = shape;
  for (const Source& source : sources) {
    if (source.n_rows == 0) continue;
    count[0] = source.n_rows;
    checked(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr), "map",
            dataset);
    const Hdf5Handle source_space = make_space(count);
    checked(H5Pset_virtual(creation.id(), space.id(), source.file.c_str(), dataset.c_str(), source_space.id()), "map",
            dataset);
    first[0] += source.n_rows;
  }
  checked(H5Sselect_all(space.id()), "map", dataset);
  handle(H5Dcreate2(file_.id(), dataset.c_str(), type_in_file(number), space.id(), make_groups_.id(), creation.id(),
                    H5P_DEFAULT),
         H5Dclose, "map", dataset);
  if (!unit.empty()) set_attribute(dataset, "unit", unit);
}

void Hdf5Writer::write_row_views(const std::string& group, const std::string& dataset, const Number number,
                                 const Shape& shape) {
  const Hdf5Handle source = make_space(shape);
  const Shape row_shape(shape.begin() + 1, shape.end());
  Shape first(shape.size(), 0);
  Shape count = shape;
  count[0] = 1;
  for (; first[0] < shape[0]; ++first[0]) {
    const std::string name = fmt::format("{}/{}", group, first[0]);
    checked(H5Sselect_hyperslab(source.id(), H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr), "map",
            name);
    const Hdf5Handle space = make_space(row_shape);
    const Hdf5Handle creation = make_virtual_creation(number, name);
    constexpr const char* this_file = ".";
    checked(H5Pset_virtual(creation.id(), space.id(), this_file, dataset.c_str(), source.id()), "map", name);
    handle(H5Dcreate2(file_.id(), name.c_str(), type_in_file(number), space.id(), make_groups_.id(), creation.id(),
                      H5P_DEFAULT),
           H5Dclose, "map", name);
  }
}

void Hdf5Writer::link(const std::string& existing, const std::string& name) {
  checked(H5Lcreate_hard(file_.id(), existing.c_str(), file_.id(), name.c_str(), make_groups_.id(), H5P_DEFAULT),
          "link", name);
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name, const hid_t type,
                                 const Hdf5Handle& space, const void* value) {
  const std::string what = fmt::format("write attribute '{}' of", name);
  checked(type, what.c_str(), object);
  checked(space.id(), what.c_str(), object);
  const Hdf5Handle owner = open_object(file_, object);
  checked(owner.id(), what.c_str(), object);
  const Hdf5Handle attribute = handle(H5Acreate2(owner.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                                      H5Aclose, what.c_str(), object);
  checked(H5Awrite(attribute.id(), type, value), what.c_str(), object);
}

void Hdf5Writer::set_attribute(const std::string& object, const std::string& name, const std::string& text) {
  const char* value = text.c_str();
  write_attribute(object, name, make_text_type().id(), make_space({}), &value);
}

void Hdf5Writer::set_attribute(const std::string& object, const std::string& name,
                               const std::vector<std::string>& texts) {
  std::vector<const char*> values;
  for (const std::string& text : texts) values.push_back(text.c_str());
  write_attribute(object, name, make_text_type().id(), make_space({values.size()}), values.data());
}

void Hdf5Writer::set_attribute(const std::string& object, const std::string& name,
                               const std::vector<std::int64_t>& values) {
  write_attribute(object, name, H5T_NATIVE_INT64, make_space({values.size()}), values.data());
}

void Hdf5Writer::set_attribute(const std::string& object, const std::string& name, const std::int64_t value) {
  write_attribute(object, name, H5T_NATIVE_INT64, make_space({}), &value);
}

void Hdf5Writer::set_reference(const std::string& object, const std::string& name, const std::string& target) {
  hobj_ref_t reference = 0;
  checked(H5Rcreate(&reference, file_.id(), target.c_str(), H5R_OBJECT, -1), "refer to", target);
  write_attribute(object, name, H5T_STD_REF_OBJ, make_space({}), &reference);
}

std::uint64_t Hdf5Writer::commit() {
  checked(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), "finish", "/");
  const ssize_t n_bytes = checked(H5Fget_file_image(file_.id(), nullptr, 0), "finish", "/");
  const std::unique_ptr<char[]> image(new char[static_cast<std::size_t>(n_bytes)]);
  checked(H5Fget_file_image(file_.id(), image.get(), static_cast<std::size_t>(n_bytes)), "finish", "/");
  checked(file_.reset(), "close", "/");

  AtomicFile file(path_);
  file.write(image.get(), static_cast<std::size_t>(n_bytes));
  file.write(make_seal({image.get(), static_cast<std::size_t>(n_bytes)}));
  file.commit();
  return file.bytes_written();
}

}  // namespace skein
