#include "studies/plan_amplification.hpp"

#include "studies/ladder_table.hpp"
#include "studies/rung_name.hpp"

#include <limits>

namespace skein {

double measure_amplification(PlanPilots& pilots, const Candidate& tube, const Pilot& pilot) {
  constexpr double stiffer = 1.05, most_of_change = 2.2;
  SceneConfig changed = tube.scene;
  for (FiberConfig& fiber : changed.fibers) fiber.spring_stiffness *= stiffer;
  const auto other = pilots.run(changed, describe_rung(tube.nodes_per_section) + ", stiffer by 5 %");
  if (!other) return 0.0;
  if (!other->failure.empty()) return std::numeric_limits<double>::infinity();
  const double change = find_largest_error(compare_answers(*other, pilot, {Question::shape}));
  return most_of_change * change / find_ladder_error(tube.nodes_per_section);
}

}  // namespace skein
