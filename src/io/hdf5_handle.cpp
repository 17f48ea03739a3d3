#include "hdf5_handle.hpp"

namespace skein {

QuietHdf5::QuietHdf5() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &print_argument_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, print_argument_); }

std::string hdf5_reason() {
  std::string reason;
  const auto keep_first = [](unsigned, const H5E_error2_t* error, void* result) -> herr_t {
    if (error->desc != nullptr) *static_cast<std::string*>(result) = error->desc;
    return 1;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

// HDF5's drivers put the system's number into their messages.
bool is_reason_of_the_system(const std::string& reason) { return reason.find("errno = ") != std::string::npos; }

std::size_t size_of(const Number number) { return number == Number::float32 || number == Number::int32 ? 4 : 8; }

hid_t type_in_memory(const Number number) {
  switch (number) {
    case Number::float32:
      return H5T_NATIVE_FLOAT;
    case Number::float64:
      return H5T_NATIVE_DOUBLE;
    case Number::int32:
      return H5T_NATIVE_INT32;
    default:
      return H5T_NATIVE_INT64;
  }
}

hid_t type_in_file(const Number number) {
  switch (number) {
    case Number::float32:
      return H5T_IEEE_F32LE;
    case Number::float64:
      return H5T_IEEE_F64LE;
    case Number::int32:
      return H5T_STD_I32LE;
    default:
      return H5T_STD_I64LE;
  }
}

}  // namespace skein
