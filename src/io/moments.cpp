#include "moments.hpp"

#include <fmt/format.h>

namespace skein {

Moments read_moments(const Hdf5Reader& file, const std::string& element) {
  Moments moments;
  moments.time = file.read_reals(element + "/time", {any_extent});
  moments.step = file.read_integers(element + "/step", {moments.n_rows()});
  for (std::size_t i = 0; i < moments.time.size(); ++i) {
    if (i > 0 && !(moments.time[i] > moments.time[i - 1]))
      file.reject(element + "/time",
                  fmt::format("time {} is {}, and the one before is {}", i, moments.time[i], moments.time[i - 1]));
    if (moments.step[i] < (i > 0 ? moments.step[i - 1] : 0))
      file.reject(element + "/step", fmt::format("step {} is {}, less than the one before", i, moments.step[i]));
  }
  return moments;
}

}  // namespace skein
