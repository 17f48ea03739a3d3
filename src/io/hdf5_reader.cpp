#include "hdf5_reader.hpp"

#include <skein/core/error.hpp>
#include <skein/io/read_file.hpp>

#include "checksum.hpp"

#include <fmt/format.h>

#include <cmath>

namespace skein {
namespace {

// A part of a run that is not there is damage of the run.
void check_file(const std::filesystem::path& path, const bool with_seal) {
  try {
    with_seal ? check_seal(path) : check_is_file(path);
  } catch (const Error& error) {
    if (error.code() != ExitCode::missing_input) throw;
    throw Error(ExitCode::damaged_data, fmt::format("'{}' is gone.", path.string()));
  }
}

}  // namespace

Hdf5Reader::Hdf5Reader(std::filesystem::path path, const bool check_seal)
    : path_(std::move(path)), file_(-1, H5Fclose) {
  check_file(path_, check_seal);
  file_ = {H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
  if (!file_.valid()) fail("/");
}

void Hdf5Reader::fail(const std::string& object) const {
  const std::string reason = hdf5_reason();
  throw Error(is_reason_of_the_system(reason) ? ExitCode::io_error : ExitCode::damaged_data,
              fmt::format("cannot read '{}' in '{}': {}.", object, path_.string(), reason));
}

void Hdf5Reader::reject(const std::string& object, const std::string& why) const {
  throw Error(ExitCode::damaged_data, fmt::format("'{}' in '{}' is damaged: {}.", object, path_.string(), why));
}

// Each link on the way is looked at before it is followed.
Hdf5Handle Hdf5Reader::open(const std::string& object) const {
  for (std::size_t end = 0; object != "/" && end != std::string::npos;) {
    end = object.find('/', end + 1);
    const std::string part = object.substr(0, end);
    H5L_info_t link;
    if (H5Lget_info(file_.id(), part.c_str(), &link, H5P_DEFAULT) < 0) reject(object, "it is not there");
    if (link.type != H5L_TYPE_HARD) reject(object, fmt::format("{} is a link to another place", part));
  }
  Hdf5Handle opened(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!opened.valid()) fail(object);
  return opened;
}

Hdf5Handle Hdf5Reader::open_attribute(const std::string& object, const std::string& name) const {
  const std::string whole_name = object + "@" + name;
  const Hdf5Handle owner = open(object);
  if (H5Aexists(owner.id(), name.c_str()) <= 0) reject(whole_name, "it is not there");
  Hdf5Handle attribute(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail(whole_name);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  Shape shape;
  if (!space.valid() || !read_shape(space.id(), shape) || !(shape.empty() || shape == Shape{1}))
    reject(whole_name, fmt::format("its shape is {} and should be {}", describe_shape(shape), describe_shape({})));
  return attribute;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists(open(object).id(), name.c_str()) > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  constexpr std::size_t largest_fixed_text = 1 << 16;  // an attribute's limit
  const std::string whole_name = object + "@" + name;
  const Hdf5Handle attribute = open_attribute(object, name);
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
  if (!type.valid() || H5Tget_class(type.id()) != H5T_STRING) reject(whole_name, "it is no text");
  if (H5Tis_variable_str(type.id()) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute.id(), type.id(), &text) < 0) fail(whole_name);
    std::string result(text == nullptr ? "" : text);
    H5free_memory(text);
    return result;
  }
  const std::size_t size = H5Tget_size(type.id());
  if (size == 0 || size > largest_fixed_text) reject(whole_name, fmt::format("it is a text of {} bytes", size));
  std::string text(size, '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0) fail(whole_name);
  return text.substr(0, text.find('\0'));
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) const {
  const std::string whole_name = object + "@" + name;
  const Hdf5Handle attribute = open_attribute(object, name);
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
  if (!type.valid() || H5Tequal(type.id(), type_in_file(Number::int64)) <= 0)
    reject(whole_name, "it is no integer of 8 bytes");
  std::int64_t value = 0;
  if (H5Aread(attribute.id(), type_in_memory(Number::int64), &value) < 0) fail(whole_name);
  return value;
}

Hdf5Reader::OpenDataset Hdf5Reader::open_dataset(const std::string& dataset, const Shape& shape) const {
  OpenDataset opened{open(dataset), {}};
  const std::string fault = find_dataset_fault(file_.id(), opened.id.id(), shape, opened.content);
  if (!fault.empty()) reject(dataset, fault);
  return opened;
}

void Hdf5Reader::read_into(const OpenDataset& source, const std::string& dataset, const hid_t type,
                           void* values) const {
  if (source.content.n_values == 0) return;
  if (H5Dread(source.id.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail(dataset);
}

std::vector<std::byte> Hdf5Reader::read_raw(const std::string& dataset, const Number number, const Shape& shape) const {
  const OpenDataset source = open_dataset(dataset, shape);
  if (source.content.number != number) reject(dataset, "its numbers are of another type than those that are written");
  std::vector<std::byte> values(source.content.n_values * size_of(number));
  read_into(source, dataset, type_in_memory(number), values.data());
  return values;
}

std::vector<std::int64_t> Hdf5Reader::read_integers(const std::string& dataset, const Shape& shape) const {
  const OpenDataset source = open_dataset(dataset, shape);
  if (source.content.number != Number::int64) reject(dataset, "its numbers are no integers of 8 bytes");
  std::vector<std::int64_t> values(source.content.n_values);
  read_into(source, dataset, H5T_NATIVE_INT64, values.data());
  return values;
}

std::vector<double> Hdf5Reader::read_reals(const std::string& dataset, const Shape& shape, const Values allowed) const {
  const OpenDataset source = open_dataset(dataset, shape);
  if (source.content.number != Number::float32 && source.content.number != Number::float64)
    reject(dataset, "its numbers are no reals");
  std::vector<double> values(source.content.n_values);
  read_into(source, dataset, H5T_NATIVE_DOUBLE, values.data());
  for (std::size_t i = 0; allowed == Values::finite && i < values.size(); ++i)
    if (!std::isfinite(values[i])) reject(dataset, fmt::format("number {} of {} is {}", i, values.size(), values[i]));
  return values;
}

}  // namespace skein
