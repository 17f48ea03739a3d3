#pragma once

#include <skein/io/run_folder.hpp>

#include <vector>

namespace skein {

/// What becomes of the fibers' values where a run has one number.
enum class OverFibers { mean, largest, smallest };

/// One thing that is measured in a run.
struct MeasuredQuantity {
  const char* name;
  const char* unit;  ///< empty for a pure number
  const char* meaning;
};

/// Of a run as a whole, and of each of its fibers. What a run does not answer, such as the hooks of one that has none,
/// is NaN.
const std::vector<MeasuredQuantity>& list_run_quantities();
const std::vector<MeasuredQuantity>& list_fiber_quantities();

/// Which of the fibers' values, or their mean over those that have one, stands for a run.
OverFibers combines_as(std::size_t fiber_quantity);

/// A run in numbers that tables of many runs hold. They follow from its frames alone, so that a run that was
/// interrupted has the same.
struct RunMeasures {
  std::vector<double> of_run;     ///< [run quantities]
  std::vector<double> of_fibers;  ///< [n_fibers][fiber quantities]

  std::size_t n_fibers() const { return of_fibers.size() / list_fiber_quantities().size(); }
  double of_fiber(std::size_t fiber, std::size_t quantity) const {
    return of_fibers[fiber * list_fiber_quantities().size() + quantity];
  }
  /// One number for all fibers.
  double over_fibers(std::size_t quantity) const;
};

/// Reads all frames. Needs Kokkos. @throws as analyze_run
RunMeasures measure_run(const RunFolder& folder);

}  // namespace skein
