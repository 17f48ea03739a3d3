#pragma once

#include "studies/plan.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// What a plan promised and what came of it.
struct PlanCheck {
  double tolerance = 0.0;
  std::optional<int> chosen;      ///< rung; none: none was good enough
  double predicted_error = 0.0;   ///< infinite for none
  double measured_error = 0.0;    ///< against the finest tube
  double seconds = 0.0;           ///< wall time of the chosen way
  double cheapest_seconds = 0.0;  ///< of the cheapest rung that is within the tolerance, as the scene runs it otherwise
};

/// Plans a scene for several tolerances and runs what was chosen, every rung up to the first that meets the tightest of
/// them, and a tube of 24 nodes on a section with a third of the steps' tolerance, which all are compared with. Needs
/// Kokkos. @param tolerances  one at least
std::vector<PlanCheck> check_plans(const SceneConfig& scene, const PlanRequest& request,
                                   const std::vector<double>& tolerances,
                                   const std::function<void(const std::string&)>& say);

}  // namespace skein
