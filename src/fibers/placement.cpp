#include <skein/core/counter_random.hpp>
#include <skein/core/error.hpp>
#include <skein/fibers/placement.hpp>
#include <skein/fibers/segment_distance.hpp>
#include <skein/fibers/start_shape.hpp>
#include <skein/fibers/tube_overlap.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

constexpr int n_tries_allowed = 10000;  ///< for the place of a fiber

/// A fiber as a straight piece of centreline, and how far its surface can be from it.
struct Capsule {
  Vec3 center, half;  ///< half: from the center to the last section
  double radius = 0.0;
};

Capsule make_capsule(const Fiber& fiber) {
  const FiberConfig& config = fiber.config;
  const double half_length = 0.5 * (config.sections - 1) * fiber.spacing();
  return {config.center, half_length / norm(config.direction) * config.direction,
          config.radius + bound_start_deflection(fiber)};
}

double gap_between(const Capsule& a, const Capsule& b) {
  // Most pairs are far apart: their spheres tell.
  const double spheres = norm(a.center - b.center) - norm(a.half) - norm(b.half) - a.radius - b.radius;
  if (spheres > std::max(a.radius, b.radius)) return spheres;
  return compute_segment_distance(a.center - a.half, a.center + a.half, b.center - b.half, b.center + b.half) -
         a.radius - b.radius;
}

bool is_inside(const Capsule& fiber, const Vec3 center, const Vec3 box) {
  const Vec3 d = fiber.center - center;
  const auto fits = [&fiber](const double offset, const double half, const double side) {
    return std::abs(offset) + std::abs(half) + fiber.radius <= 0.5 * side;
  };
  return fits(d.x, fiber.half.x, box.x) && fits(d.y, fiber.half.y, box.y) && fits(d.z, fiber.half.z, box.z);
}

/// Random place and direction of a fiber, by the number of the try.
class RandomPlace {
 public:
  RandomPlace(const SceneConfig& scene, const std::size_t fiber)
      : placement_(scene.placement),
        random_(scene.seed, CounterRandom::Purpose::placement, static_cast<std::uint32_t>(fiber)) {}

  Vec3 center(const int number) const {
    const auto [x, y] = random_.draw(4 * static_cast<std::uint64_t>(number));
    const double z = random_.draw(4 * static_cast<std::uint64_t>(number) + 1)[0];
    const Vec3 box = placement_.box;
    return placement_.center + Vec3{(x - 0.5) * box.x, (y - 0.5) * box.y, (z - 0.5) * box.z};
  }
  Vec3 direction(const int number) const {
    const auto [height, turn] = random_.draw(4 * static_cast<std::uint64_t>(number) + 2);
    const double z = 2.0 * height - 1.0;
    const double angle = 2.0 * std::numbers::pi * turn;
    const double side = std::sqrt(1.0 - z * z);
    return {side * std::cos(angle), side * std::sin(angle), z};
  }

 private:
  const PlacementConfig& placement_;
  CounterRandom random_;
};

bool draws_directions(const Orientation orientation) {
  switch (orientation) {
    case Orientation::as_written:
      return false;
    case Orientation::random:
      return true;
  }
  throw Error(ExitCode::internal, "draws_directions knows no such orientation");
}

std::vector<FiberConfig> place_on_grid(const SceneConfig& scene) {
  const PlacementConfig& placement = scene.placement;
  const bool turned = draws_directions(placement.orientation);
  const Vec3 n = placement.grid;
  std::vector<FiberConfig> fibers;
  for (double k = 0.0; k < n.z; ++k)
    for (double j = 0.0; j < n.y; ++j)
      for (double i = 0.0; i < n.x; ++i) {
        FiberConfig fiber = scene.fibers[fibers.size() % scene.fibers.size()];
        const Vec3 s = placement.spacing;
        fiber.center = placement.center + Vec3{(i - 0.5 * (n.x - 1.0)) * s.x, (j - 0.5 * (n.y - 1.0)) * s.y,
                                               (k - 0.5 * (n.z - 1.0)) * s.z};
        if (turned) fiber.direction = RandomPlace(scene, fibers.size()).direction(0);
        fibers.push_back(fiber);
      }
  return fibers;
}

std::string describe_box(const Vec3 box) { return fmt::format("{:g} x {:g} x {:g}", box.x, box.y, box.z); }

[[noreturn]] void reject_full_box(const SceneConfig& scene, const std::vector<Capsule>& placed, const Fiber& next) {
  const PlacementConfig& placement = scene.placement;
  double volume = 0.0;
  for (const Capsule& fiber : placed)
    volume += std::numbers::pi * std::pow(fiber.radius + 0.5 * placement.gap, 2) * 2.0 * norm(fiber.half);
  throw Error(
      ExitCode::scene_error,
      fmt::format("placement: {} of {} random fibers fit into the box {}; for the next one, {:.4g} long, {} tries "
                  "found no place with a gap of {:g} (what is there with half the gap fills {:.3g} of the box). "
                  "Make placement.box larger, or placement.count or placement.gap smaller.",
                  placed.size(), placement.count, describe_box(placement.box), next.length(), n_tries_allowed,
                  placement.gap, volume / (placement.box.x * placement.box.y * placement.box.z)));
}

bool find_place(const SceneConfig& scene, const std::vector<Capsule>& placed, Fiber& fiber) {
  const PlacementConfig& placement = scene.placement;
  const RandomPlace place(scene, placed.size());
  for (int number = 0; number < n_tries_allowed; ++number) {
    fiber.config.center = place.center(number);
    if (draws_directions(placement.orientation)) fiber.config.direction = place.direction(number);
    const Capsule capsule = make_capsule(fiber);
    if (!is_inside(capsule, placement.center, placement.box)) continue;
    const bool is_free = std::all_of(placed.begin(), placed.end(), [&](const Capsule& other) {
      return gap_between(capsule, other) >= placement.gap;
    });
    if (is_free) return true;
  }
  return false;
}

std::vector<FiberConfig> place_randomly(const SceneConfig& scene) {
  std::vector<FiberConfig> fibers;
  std::vector<Capsule> placed;
  while (static_cast<int>(fibers.size()) < scene.placement.count) {
    Fiber fiber;
    fiber.config = scene.fibers[fibers.size() % scene.fibers.size()];
    if (!find_place(scene, placed, fiber)) reject_full_box(scene, placed, fiber);
    placed.push_back(make_capsule(fiber));
    fibers.push_back(fiber.config);
  }
  return fibers;
}

double compute_distance(const TubePiece& a, const TubePiece& b) {
  return compute_segment_distance(a.first.center, a.last.center, b.first.center, b.last.center);
}

/// Smallest distance of the centrelines of pieces that overlap; infinite where none do.
double find_overlap(const Fiber& a, const Fiber& b, const std::uint64_t seed) {
  const double needed = a.config.radius + b.config.radius;
  double smallest = std::numeric_limits<double>::infinity();
  const auto others = list_tube_pieces(make_section_poses(b, seed), b.config.radius);
  for (const TubePiece& piece : list_tube_pieces(make_section_poses(a, seed), a.config.radius))
    for (const TubePiece& other : others) {
      const double distance = compute_distance(piece, other);
      if (distance < std::min(needed, smallest) && !are_apart(piece, other)) smallest = distance;
    }
  return smallest;
}

std::vector<FiberConfig> place(const SceneConfig& scene) {
  switch (scene.placement.kind) {
    case PlacementKind::as_written:
      return scene.fibers;
    case PlacementKind::grid:
      return place_on_grid(scene);
    case PlacementKind::random:
      return place_randomly(scene);
  }
  throw Error(ExitCode::internal, "place knows no such kind of placement");
}

}  // namespace

SceneConfig place_fibers(const SceneConfig& scene) {
  SceneConfig placed = scene;
  placed.fibers = place(scene);
  placed.placement.kind = PlacementKind::as_written;
  return placed;
}

std::vector<KeyProblem> find_overlap_problems(const SceneConfig& scene, const std::vector<Fiber>& placed) {
  const bool is_grid = scene.placement.kind == PlacementKind::grid;
  const char* advice = is_grid ? "Make placement.spacing larger." : "Move one of them, or let [placement] find places.";
  std::vector<Capsule> capsules;
  for (const Fiber& fiber : placed) capsules.push_back(make_capsule(fiber));
  std::vector<KeyProblem> problems;
  for (std::size_t i = 0; i < placed.size() && !(is_grid && !problems.empty()); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (gap_between(capsules[i], capsules[j]) >= 0.0) continue;
      const double distance = find_overlap(placed[j], placed[i], scene.seed);
      if (!std::isfinite(distance)) continue;
      problems.push_back(
          {is_grid ? "placement.spacing" : fmt::format("fiber[{}].center", i),
           fmt::format("fibers {} and {} overlap at the start: their centrelines come as near as {:.4g}, and their "
                       "radii together are {:.4g}. {}",
                       j, i, distance, placed[i].config.radius + placed[j].config.radius, advice)});
      break;
    }
  return problems;
}

}  // namespace skein
