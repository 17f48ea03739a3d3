#include <skein/core/error.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/fibers/start_check.hpp>
#include <skein/scene/scene_size.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace skein {
namespace {

/// Why a fiber cannot start so; empty where it can.
std::string find_fault(const Fiber& fiber, const std::uint64_t seed) {
  std::vector<SectionPose> poses;
  try {
    poses = make_section_poses(fiber, seed);
  } catch (const Error& error) {
    if (error.code() != ExitCode::scene_error) throw;
    return "the fiber's length does not reach so far";
  }
  const double strain = measure_start_strain(fiber, poses);
  if (!(strain <= largest_sound_strain))
    return fmt::format("a spring would be strained by {:.0f} %, and {:.0f} % is the most", 100.0 * strain,
                       100.0 * largest_sound_strain);
  return touches_itself(fiber, poses) ? "the fiber would touch itself" : "";
}

/// The largest value of a key up to the one it has with which a fiber can start, rounded down to three digits.
double find_largest(const Fiber& asked, double FiberConfig::*const key, const std::uint64_t seed) {
  Fiber fiber = asked;
  double low = 0.0, high = fiber.config.*key;
  constexpr int n_halvings = 30;
  for (int i = 0; i < n_halvings; ++i) {
    const double middle = 0.5 * (low + high);
    fiber.config.*key = middle;
    (find_fault(fiber, seed).empty() ? low : high) = middle;
  }
  if (!(low > 0.0)) return 0.0;
  const double digit = std::pow(10.0, std::floor(std::log10(low)) - 2.0);
  return std::floor(low / digit) * digit;
}

/// Of the main bend alone.
std::vector<KeyProblem> find_bend_problems(const std::string& path, Fiber fiber, const std::uint64_t seed) {
  FiberConfig& config = fiber.config;
  if (config.start_amplitude == 0.0) return {};
  config.start_noise = 0.0;
  const int most = config.sections / sections_per_half_wave;
  if (most == 0)
    return {{path + ".start_amplitude",
             fmt::format("{}.start_amplitude {:g}: {} sections are too few for a bend, {} show half a wave", path,
                         config.start_amplitude, config.sections, sections_per_half_wave)}};
  if (config.start_mode > most)
    return {
        {path + ".start_mode", fmt::format("{}.start_mode {}: {} sections resolve at most {} half waves, {} each", path,
                                           config.start_mode, config.sections, most, sections_per_half_wave)}};
  const std::string fault = find_fault(fiber, seed);
  if (fault.empty()) return {};
  return {{path + ".start_amplitude",
           fmt::format("{}.start_amplitude {:g} is too large for start_mode {}: {}; the largest possible is {:g}", path,
                       config.start_amplitude, config.start_mode, fault,
                       find_largest(fiber, &FiberConfig::start_amplitude, seed))}};
}

/// @param index  of the fiber among all copies
std::vector<KeyProblem> find_noise_problems(const std::string& path, const FiberConfig& config, const int index,
                                            const std::uint64_t seed) {
  const Fiber fiber{config, 0, 0, index};
  const std::string fault = find_fault(fiber, seed);
  if (fault.empty()) return {};
  return {{path + ".start_noise",
           fmt::format("{}.start_noise {:g} is too large for fiber {}: {}; the largest possible is {:g}", path,
                       config.start_noise, index, fault, find_largest(fiber, &FiberConfig::start_noise, seed))}};
}

}  // namespace

namespace {

/// Of the surface that a line has none of: how much a tube of its radius would be strained at the sharpest turn.
double measure_line_strain(const Fiber& fiber, const std::vector<SectionPose>& poses) {
  double turn = 0.0;
  for (std::size_t s = 0; s + 1 < poses.size(); ++s)
    turn = std::max(turn, norm(poses[s + 1].axes.along - poses[s].axes.along));
  return fiber.config.radius * turn / fiber.spacing();
}

}  // namespace

double measure_start_strain(const Fiber& fiber, const std::vector<SectionPose>& poses) {
  if (fiber.config.is_line()) return measure_line_strain(fiber, poses);
  const int n = fiber.config.sections, reach = fiber.config.reach_along;
  int sharpest = 0;  // the section before the sharpest turn
  double least_cosine = 2.0;
  for (int s = 0; s + 1 < n; ++s) {
    const double cosine = dot(poses[s].axes.along, poses[s + 1].axes.along);
    if (cosine < least_cosine) {
      least_cosine = cosine;
      sharpest = s;
    }
  }
  const int first = std::max(0, sharpest - reach), end = std::min(n, sharpest + 2 + reach);
  Fiber piece = fiber;
  piece.first_node = 0;
  piece.config.sections = end - first;
  std::vector<Vec3> node;
  for (int s = first; s < end; ++s) append_section_nodes(fiber.config, poses[s], node);
  const SpringNetwork network = make_spring_network(piece);
  double strain = 0.0;
  for_each_spring(network, [&](const int a, const int b, const int entry) {
    strain = std::max(strain, std::abs(norm(node[a] - node[b]) / network.stencil.rest_length[entry] - 1.0));
  });
  return strain;
}

bool touches_itself(const Fiber& fiber, const std::vector<SectionPose>& poses) {
  const Vec3 direction = fiber.config.direction / norm(fiber.config.direction);
  const double needed = 2.0 * fiber.config.radius;
  const int n = fiber.config.sections;
  for (int i = 0; i < n; ++i)
    for (int j = i + fiber.distant_sections(); j < n; ++j) {
      const Vec3 between = poses[j].center - poses[i].center;
      if (dot(between, direction) >= needed) break;
      if (norm(between) < needed) return true;
    }
  return false;
}

double measure_bend(const Fiber& fiber, const std::span<const Vec3> position) {
  const int n = fiber.n_nodes();
  const auto place = [&](const int node) { return (node - 0.5 * (n - 1)) * fiber.spacing(); };
  Vec3 center, moment;
  for (int node = 0; node < n; ++node) {
    center = center + position[node] / static_cast<double>(n);
    moment = moment + place(node) * position[node];
  }
  double bend = 0.0;
  for (int node = 0; node < n; ++node)
    bend = std::max(bend, norm(position[node] - center - (place(node) / norm(moment)) * moment));
  return bend;
}

std::vector<KeyProblem> find_start_problems(const SceneConfig& scene) {
  std::vector<KeyProblem> problems;
  const int n_fibers = static_cast<int>(scene.fibers.size()), n_copies = static_cast<int>(count_fibers(scene));
  for (int i = 0; i < n_fibers; ++i) {
    const FiberConfig& config = scene.fibers[i];
    const std::string path = n_fibers == 1 ? "fiber" : fmt::format("fiber[{}]", i);
    auto found = find_bend_problems(path, {config, 0, 0, i}, scene.seed);
    // Each copy has bends of its own.
    if (config.start_noise > 0.0)
      for (int copy = i; copy < n_copies && found.empty(); copy += n_fibers)
        found = find_noise_problems(path, config, copy, scene.seed);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  return problems;
}

}  // namespace skein
