#include "studies/rung.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/fiber_kinds.hpp>
#include <skein/physics/chain.hpp>
#include <skein/physics/rigid_tube.hpp>
#include <skein/scene/fiber_spacing.hpp>

#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace skein {
namespace {

constexpr double most_radii = 120.0;  ///< length of the rigid tubes that are compared: ends count, more middle does not

RigidTubeDrag measure(const FiberConfig& tube) { return measure_rigid_tube(make_fibers({tube})[0], 1.0); }

/// Both pieces of one length, whole sections of either.
FiberConfig cut_to(FiberConfig fiber, const double length) {
  const double spacing = compute_section_spacing(fiber);
  fiber.sections = std::max(2, static_cast<int>(std::lround(length / spacing)));
  fiber.spacing = length / fiber.sections;
  return fiber;
}

/// The blob at which the tube has this effective aspect ratio, which falls as the blob grows.
double find_blob(FiberConfig fiber, const double aspect_ratio) {
  const double distance = std::max(compute_node_spacing(fiber), compute_section_spacing(fiber));
  const auto excess = [&](const double blob) {
    fiber.blob = blob;
    return measure(fiber).effective_aspect_ratio() / aspect_ratio - 1.0;
  };
  double low = 0.2 * distance, high = low, above = excess(low), below = above;
  constexpr double largest = 2.5;
  while (below > 0.0 && high < largest * distance) {
    low = high;
    above = below;
    high = std::min(1.3 * high, largest * distance);
    below = excess(high);
  }
  if (!(above >= 0.0) || !(below <= 0.0))
    throw Error(ExitCode::scene_error,
                fmt::format("no blob makes {} nodes on a section meet the fluid as the fiber's {:g} with its own does",
                            fiber.nodes_per_section, fiber.radius));
  for (int step = 0; step < 60 && high - low > 1e-7 * high; ++step) {
    // The secant's point, kept off the ends, which converges for a function this straight.
    const double share = std::clamp(above / (above - below), 0.02, 0.98);
    const double middle = low + share * (high - low), found = excess(middle);
    (found > 0.0 ? low : high) = middle;
    (found > 0.0 ? above : below) = found;
  }
  return 0.5 * (low + high);
}

int scale_section(const int section, const int before, const int after) {
  const auto scale = [&](const int from_end) {
    return static_cast<int>(std::lround(from_end * (after - 1.0) / (before - 1.0)));
  };
  return section >= 0 ? scale(section) : -1 - scale(-1 - section);
}

/// Tethers, torques and clamps of every fiber at the places that they had, now that fibers have other numbers of
/// sections.
/// @param before  [n_fibers], their numbers then
void move_loads(SceneConfig& scene, const std::vector<int>& before) {
  const auto rescale = [&](auto& loads) {
    for (auto& load : loads) {
      const std::size_t fiber = static_cast<std::size_t>(load.fiber) % scene.fibers.size();
      load.section = scale_section(load.section, before[fiber], scene.fibers[fiber].sections);
    }
  };
  rescale(scene.tethers);
  rescale(scene.torques);
  rescale(scene.clamps);
}

SceneConfig make_line_scene(SceneConfig scene, const FiberModel model) {
  std::vector<int> before;
  for (FiberConfig& fiber : scene.fibers) {
    before.push_back(fiber.sections);
    fiber.model = model;
  }
  scene = resolve_chains(scene);
  move_loads(scene, before);
  return scene;
}

}  // namespace

int find_rung(const FiberConfig& fiber) {
  if (fiber.is_rigid()) return rigid_rung;
  return fiber.is_line() ? chain_rung : fiber.nodes_per_section;
}

std::string find_bar_to_rigid(const SceneConfig& scene) {
  const auto has = [&](const auto& property) {
    return std::any_of(scene.fibers.begin(), scene.fibers.end(), property);
  };
  if (has([](const FiberConfig& fiber) { return fiber.start_amplitude > 0.0 || fiber.start_noise > 0.0; }))
    return "fibers start bent";
  if (!scene.torques.empty()) return "torques turn sections";
  if (!scene.undulations.empty()) return "fibers undulate";
  if (!scene.clamps.empty()) return "clamps turn sections";
  if (has([](const FiberConfig& fiber) { return fiber.is_helix(); })) return "a fiber is a helix at rest";
  if (scene.time.method == TimeMethod::trbdf2) return "time.method is \"trbdf2\"";
  return {};
}

RungFit fit_rung(const FiberConfig& fiber, const int nodes_per_section) {
  RungFit fit{fiber};
  if (fiber.nodes_per_section == nodes_per_section) return fit;
  if (fiber.is_line())
    throw Error(ExitCode::scene_error, "a line has no surface that other numbers of nodes could resolve");
  const Fiber fine = make_fibers({fiber})[0];
  FiberConfig& coarse = fit.fiber;
  coarse.nodes_per_section = nodes_per_section;
  coarse.spacing = 0.0;
  if (fiber.reach_around > 0)
    coarse.reach_around = std::max(
        1, static_cast<int>(std::lround(1.0 * fiber.reach_around * nodes_per_section / fiber.nodes_per_section)));
  coarse = cut_to(coarse, fine.length());

  const double length = std::min(fine.length(), most_radii * fiber.radius);
  const RigidTubeDrag drag = measure(cut_to(fiber, length));
  const double aspect_ratio = drag.effective_aspect_ratio();
  FiberConfig piece = cut_to(coarse, length);
  coarse.blob = piece.blob = find_blob(piece, aspect_ratio);
  const RigidTubeDrag found = measure(piece);
  fit.aspect_ratio_error = found.effective_aspect_ratio() / aspect_ratio - 1.0;
  fit.drag_ratio = found.turning / drag.turning;
  // Rigidity is in proportion to the springs' stiffness.
  coarse.spring_stiffness *= fit.drag_ratio * measure_beam_stiffness(fine).relaxed_bending /
                             measure_beam_stiffness(make_fibers({coarse})[0]).relaxed_bending;
  return fit;
}

SceneConfig make_rung_scene(SceneConfig scene, const int rung) {
  if (rung == rigid_rung) return make_line_scene(std::move(scene), FiberModel::rigid);
  if (rung == chain_rung) return make_line_scene(std::move(scene), FiberModel::chain);
  std::vector<int> before;
  FiberKinds rungs([&](const FiberConfig& fiber) { return fit_rung(fiber, rung).fiber; });
  for (FiberConfig& fiber : scene.fibers) {
    before.push_back(fiber.sections);
    fiber = rungs.find(fiber);
  }
  move_loads(scene, before);
  return scene;
}

}  // namespace skein
