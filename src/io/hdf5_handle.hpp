#pragma once

#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

namespace skein {

/// Closes an HDF5 identifier with the function that its kind asks for.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle(const hid_t id, const Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, -1);
      close_ = other.close_;
    }
    return *this;
  }

  hid_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }

  /// Closes now; negative if HDF5 could not.
  herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_;
  Close close_;
};

/// While it lives HDF5 prints nothing of its own: every return code is checked, and errors become exceptions.
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* print_argument_ = nullptr;
};

/// What HDF5 itself says about the call that just failed: its innermost message.
std::string hdf5_reason();

/// Whether such a message tells that the system could not read or open, rather than that a content is wrong.
bool is_reason_of_the_system(const std::string& reason);

/// Extents of an array; empty for a single number.
using Shape = std::vector<hsize_t>;

/// How a number is stored. Files are little-endian whatever the machine.
enum class Number { float32, float64, int32, int64 };

std::size_t size_of(Number number);
hid_t type_in_memory(Number number);
hid_t type_in_file(Number number);

}  // namespace skein
