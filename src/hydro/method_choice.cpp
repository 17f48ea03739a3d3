#include <skein/hydro/method_choice.hpp>

#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

double harmonic_floor(const double blob, const double half_width) { return 0.011 * std::pow(blob / half_width, 4); }

FmmPlan choose_fmm_plan(const FmmOptions& options, const double max_blob) {
  FmmPlan plan;
  plan.order = options.order > 0 ? options.order : std::clamp(static_cast<int>(std::ceil(1.3 - std::log10(options.tolerance))), 4, 16);
  plan.singular_cutoff = options.singular_cutoff > 0.0 ? options.singular_cutoff : 1e-14;
  plan.leaf_size = options.leaf_size > 0 ? options.leaf_size : 64;
  plan.min_half_width =
      options.min_half_width > 0.0 ? options.min_half_width : max_blob * std::pow(0.011 / options.tolerance, 0.25);
  plan.near_in_single = plan.far_in_single = options.precision == FmmPrecision::in_single;
  return plan;
}

}  // namespace skein
