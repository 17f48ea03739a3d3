#include "runs/known_contact.hpp"

#include "runs/fiber_in_shear.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

std::string describe_models(const ContactRow& row) {
  if (row.finest == 1) return "a chain";
  return row.coarsest == row.finest ? fmt::format("{} nodes on a section", row.finest)
                                    : fmt::format("{} to {} nodes on a section", row.coarsest, row.finest);
}

}  // namespace

const std::vector<ContactRow>& list_known_contacts() {
  constexpr double soft = 703.0, paper = 2813.0, stiff = 11250.0;  // a quarter, once and four times the paper's
  constexpr double shown = 78.1;
  static const std::vector<ContactRow> rows{
      {39.2, soft, 6, 6, never, shown},   {104.7, soft, 6, 6, 26.4, shown},   {104.7, paper, 1, 1, never, shown},
      {104.7, paper, 4, 6, never, shown}, {186.2, soft, 6, 6, 28.2, shown},   {186.2, paper, 1, 1, 33.8, shown},
      {186.2, paper, 4, 9, 35.5, shown},  {186.2, stiff, 6, 6, never, shown}, {456.0, paper, 1, 1, 43.8, shown},
      {456.0, paper, 4, 6, 43.5, shown},
  };
  return rows;
}

std::vector<ContactRow> find_known_contacts(const SceneConfig& scene) {
  if (scene.repulsion.strength > 0.0) return {};
  const auto fiber = find_fiber_in_shear(scene);
  if (!fiber) return {};
  const double aspect_ratio = fiber->aspect_ratio, stiffness = fiber->stiffness;
  std::vector<ContactRow> found;
  constexpr double length_factor = 1.1, stiffness_factor = 1.3;
  for (const ContactRow& row : list_known_contacts()) {
    // What never meets does not if it is shorter or stiffer, either.
    const bool meets = std::isfinite(row.first_inside);
    if (aspect_ratio <= length_factor * row.aspect_ratio && stiffness_factor * stiffness >= row.stiffness &&
        (!meets || (length_factor * aspect_ratio >= row.aspect_ratio && stiffness <= stiffness_factor * row.stiffness)))
      found.push_back(row);
  }
  return found;
}

std::string describe_known_contact(const SceneConfig& scene) {
  if (scene.repulsion.strength > 0.0)
    return "contact: the [repulsion] keeps surfaces apart if it is stronger than what presses them; a run tells how "
           "near they come";
  if (is_single_fiber(scene) && scene.fibers.front().is_rigid())
    return "contact: a straight fiber alone touches nothing";
  const auto rows = find_known_contacts(scene);
  if (rows.empty())
    return "contact: nothing is known before this scene has run; a run counts nodes inside of surfaces, and 'skein "
           "plan "
           "--for contact' looks for a rung without them";
  const double rate = std::abs(scene.flows.front().rate);
  std::vector<std::string> times;
  double first = never, shown = never;
  for (const ContactRow& row : rows) {
    first = std::min(first, row.first_inside / rate);
    shown = std::min(shown, row.shown / rate);
    times.push_back(std::isfinite(row.first_inside)
                        ? fmt::format("from t = {:.3g} on with {}", row.first_inside / rate, describe_models(row))
                        : fmt::format("never with {}", describe_models(row)));
  }
  if (!std::isfinite(first))
    return fmt::format("contact: surfaces of such a fiber did not meet up to t = {:.3g}, with any rung that was run",
                       shown);
  return fmt::format("contact: ends of such a fiber are pressed into its sides, {}; {}", fmt::join(times, ", "),
                     scene.time.end < first ? "this scene ends before" : advise_on_contact(false));
}

std::string advise_on_contact(const bool has_repulsion) {
  return has_repulsion ? "the repulsion is weak here; take a larger repulsion.strength"
                       : "no number of nodes keeps surfaces apart that a flow presses together, a [repulsion] does";
}

}  // namespace skein
