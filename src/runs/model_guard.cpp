#include "runs/model_guard.hpp"

#include <skein/fibers/start_check.hpp>

#include "runs/known_contact.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skein {

ModelGuard::ModelGuard(const std::vector<Fiber>& fibers, const bool has_repulsion) : has_repulsion_(has_repulsion) {
  for (const Fiber& fiber : fibers) {
    spacing_.push_back(fiber.spacing());
    const bool is_line = fiber.config.is_line();
    const double length = is_line ? fiber.config.radius : fiber.config.blob;
    if (length <= film_) continue;
    film_ = length;
    film_name_ = is_line ? "radius" : "blob";
  }
}

std::vector<std::string> ModelGuard::look(const StepRecord& record, const double largest_strain) {
  std::vector<std::string> news;
  const auto meet = [&](const Kind kind, const bool is_worse, const double value, const std::string& sentence) {
    if (n_steps_[kind] == 0 || is_worse) worst_[kind] = value;
    if (n_steps_[kind]++ == 0)
      news.push_back(fmt::format("warning: t = {:.6g}, step {}: {}", record.time, record.step, sentence));
  };
  double sharpest = 0.0;
  std::size_t sharpest_fiber = 0;
  for (std::size_t f = 0; f < spacing_.size(); ++f)
    if (record.curvature_max[f] * spacing_[f] > sharpest) {
      sharpest = record.curvature_max[f] * spacing_[f];
      sharpest_fiber = f;
    }
  if (sharpest > 1.0)
    meet(sharp_hook, sharpest > worst_[sharp_hook], sharpest,
         fmt::format(
             "fiber {} is bent to a radius of {:.3g}, less than the distance of its sections, {:.3g}: the bend is "
             "not resolved; take more nodes per section, which brings sections closer, or of a chain more chain_nodes",
             sharpest_fiber, 1.0 / record.curvature_max[sharpest_fiber], spacing_[sharpest_fiber]));
  if (largest_strain > largest_sound_strain)
    meet(strained_spring, largest_strain > worst_[strained_spring], largest_strain,
         fmt::format(
             "a spring is strained by {:.0f} %: springs this weak against the flow no longer act as a solid rod; "
             "take a larger spring_stiffness",
             100.0 * largest_strain));
  if (record.smallest_gap < film_)
    meet(contact, record.smallest_gap < worst_[contact] * film_, record.smallest_gap / film_,
         fmt::format("surfaces are {:.3g} apart, less than a {}, {:.3g}; {}", record.smallest_gap, film_name_, film_,
                     advise_on_contact(has_repulsion_)));
  if (record.nodes_inside > 0)
    meet(penetration, record.depth > worst_[penetration] * film_, record.depth / film_,
         fmt::format("{} nodes are inside of another surface, the deepest by {:.3g}; the {} is {:.3g}; {}",
                     record.nodes_inside, record.depth, film_name_, film_, advise_on_contact(has_repulsion_)));
  most_inside_ = std::max(most_inside_, record.nodes_inside);
  if (const auto n_crossings = static_cast<double>(record.crossings); n_crossings > worst_[crossing])
    meet(crossing, true, n_crossings,
         "centrelines have passed through each other: the shapes from here on are none "
         "that fibers could have");
  return news;
}

std::string ModelGuard::describe() const {
  const std::string film_names = film_name_ == "radius" ? "radii" : "blobs";
  std::string text;
  const auto add = [&](const Kind kind, const std::string& what) {
    if (n_steps_[kind] > 0)
      text += fmt::format("{}{} steps with {}", text.empty() ? "beyond what the model resolves: " : "; ",
                          n_steps_[kind], what);
  };
  add(sharp_hook, fmt::format("bends down to {:.2g} of the sections' distance", 1.0 / worst_[sharp_hook]));
  add(strained_spring, fmt::format("springs strained by up to {:.0f} %", 100.0 * worst_[strained_spring]));
  add(contact, fmt::format("gaps down to {:.2g} {}", worst_[contact], film_names));
  add(penetration, fmt::format("nodes inside of another surface, up to {} of them, {:.2g} {} deep", most_inside_,
                               worst_[penetration], film_names));
  add(crossing, fmt::format("centrelines that pass through each other, {} times in all", worst_[crossing]));
  if (n_steps_[contact] > 0 && n_steps_[crossing] == 0) text += "; no centreline passed through another";
  return text;
}

void ModelGuard::visit_memory(NumberVisitor& visitor) {
  const char* names[n_kinds] = {"guard.sharp_hook", "guard.strained_spring", "guard.contact", "guard.penetration",
                                "guard.crossing"};
  for (int kind = 0; kind < n_kinds; ++kind) {
    visitor.integer(std::string(names[kind]) + ".steps", n_steps_[kind]);
    visitor.number(std::string(names[kind]) + ".worst", worst_[kind]);
  }
  visitor.integer("guard.most_inside", most_inside_);
}

}  // namespace skein
