#pragma once

#include "hdf5_reader.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// When the rows of a time-dependent array were: growing finite times, and the accepted steps before them, which never
/// fall. [n_rows] both
struct Moments {
  std::vector<std::int64_t> step;
  std::vector<double> time;

  hsize_t n_rows() const { return time.size(); }
};

/// @param element  such as "/observables/energy"
/// @throws Error(damaged_data) naming the file, and the array that is not so
Moments read_moments(const Hdf5Reader& file, const std::string& element);

}  // namespace skein
