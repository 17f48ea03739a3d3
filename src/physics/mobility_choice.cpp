#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/fmm/machine_rates.hpp>
#include <skein/physics/mobility_choice.hpp>
#include <skein/physics/scene_times.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

/// Leaves side by side, of which the first and the last do not touch.
constexpr double least_cells = 3.0;

FmmOptions make_fmm_options(const SceneConfig& scene) {
  const HydrodynamicsConfig& config = scene.hydrodynamics;
  FmmOptions options;
  options.tolerance = find_sum_tolerance(scene);
  options.far_field = config.far_field;
  options.order = config.order;
  options.leaf_size = config.leaf_size;
  options.precision = config.precision;
  options.check_every = config.check_every;
  options.on_miss = config.on_miss;
  return options;
}

struct Size {
  double n_nodes = 0.0;
  double extent = 0.0;  ///< longest side of the box about all fibers at the start, length
  double max_blob = 0.0;
  bool has_equal_blobs = true;
};

Size measure_size(const SceneConfig& scene) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Size size;
  double low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
  for (const Fiber& fiber : make_fibers(scene.fibers)) {
    const FiberConfig& config = fiber.config;
    size.n_nodes += static_cast<double>(config.sections) * config.nodes_per_section;
    size.max_blob = std::max(size.max_blob, config.blob);
    size.has_equal_blobs &= config.blob == scene.fibers.front().blob;
    const Vec3 half = (0.5 * fiber.length() / norm(config.direction)) * config.direction;
    const double at[3] = {config.center.x, config.center.y, config.center.z};
    const double reach[3] = {std::abs(half.x), std::abs(half.y), std::abs(half.z)};
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], at[c] - reach[c] - config.radius);
      high[c] = std::max(high[c], at[c] + reach[c] + config.radius);
    }
  }
  for (int c = 0; c < 3; ++c) size.extent = std::max(size.extent, high[c] - low[c]);
  return size;
}

/// Leaves as large as the blobs need leave nothing far from anything else: in words, or empty.
std::string find_lack_of_far_field(const FmmOptions& options, const Size& size) {
  const double half_width = smallest_half_width(options, size.max_blob);
  if (size.extent >= 2.0 * least_cells * half_width) return {};
  return fmt::format(
      "with blobs of {:g} a tolerance of {:g} needs leaves of half-width {:.3g} or more, and all nodes lie within "
      "{:.3g}: "
      "no leaf is far from another",
      size.max_blob, options.tolerance, half_width, size.extent);
}

/// Of a scene with a symmetry whose fibers are placed; else without nodes.
NodeOrbits find_orbits(const SceneConfig& scene) {
  if (scene.symmetry.is_none()) return {};
  const std::vector<Fiber> fibers = make_fibers(scene.fibers);
  try {
    return make_node_orbits(scene.symmetry, fibers, make_surface_nodes(fibers, scene.seed));
  } catch (const Error& error) {
    if (error.code() != ExitCode::scene_error) throw;
    return {};
  }
}

/// Decides between the methods by the number of nodes and where they are. What a symmetry makes direct sums faster, it
/// makes the fast multipole method by about the root of that: half of its work is for sources, all of which remain.
/// @param gain  of direct sums
void choose_method(const SceneConfig& scene, const double gain, MobilityChoice& choice) {
  const MachineRates& rates = machine_rates(choice.fmm.path);
  choice.fmm.direct_when_cheaper = true;
  const Size size = measure_size(scene);
  choice.is_direct = true;
  const double least_nodes = rates.least_fmm_nodes * std::sqrt(gain);
  if (choice.precision == Precision::automatic)
    choice.precision = choose_direct_precision(rates, size.n_nodes * size.n_nodes / gain, choice.fmm.tolerance);
  if (size.n_nodes < least_nodes) {
    choice.reason =
        fmt::format("chosen because {}, and below {:.4g} nodes little would be gained by any other",
                    choice.precision == Precision::in_single ? "the tolerance allows it" : "it is exact", least_nodes);
  } else if (needs_direct_sum(choice.fmm)) {
    choice.reason = fmt::format("chosen because tolerance = {:g} is below what the fast multipole method promises",
                                choice.fmm.tolerance);
  } else if (const std::string lack = find_lack_of_far_field(choice.fmm, size);
             scene.fibers.size() == 1 && !lack.empty()) {
    choice.reason = "chosen because " + lack;
  } else {
    choice.is_direct = false;
    choice.reason =
        fmt::format("chosen for {:g} nodes; a direct sum wherever the tree shows that it costs less", size.n_nodes);
  }
}

}  // namespace

MobilityChoice choose_mobility(const SceneConfig& scene, const KernelPath path) {
  MobilityChoice choice;
  choice.precision = scene.hydrodynamics.precision;
  choice.fmm = make_fmm_options(scene);
  choice.fmm.path = path;
  const NodeOrbits orbits = find_orbits(scene);
  switch (scene.hydrodynamics.method) {
    case SumMethod::automatic:
      choose_method(scene, orbits.gain(), choice);
      break;
    case SumMethod::direct:
      choice.is_direct = true;
      break;
    case SumMethod::fmm:
      choice.is_direct = false;
      break;
  }
  if (orbits.n_nodes > 0) choice.orbits = choice.is_direct ? orbits.describe_images() : orbits.describe_targets();
  return choice;
}

std::string describe_direct_sum(const Precision precision) {
  switch (precision) {
    case Precision::automatic:
    case Precision::in_double:
      return "direct sum, pairs in double precision";
    case Precision::in_single:
      return "direct sum, pairs in single precision (about 1e-6)";
  }
  throw Error(ExitCode::internal, "describe_direct_sum knows no such precision");
}

std::string describe_choice(const MobilityChoice& choice, const SceneConfig& scene) {
  std::string text = choice.is_direct
                         ? describe_direct_sum(choice.precision)
                         : describe_fmm_plan(choice.fmm, choose_fmm_plan(choice.fmm, measure_size(scene).max_blob, 0));
  if (!choice.orbits.empty()) text += ", " + choice.orbits;
  if (!choice.is_direct)
    text += choice.fmm.check_every > 0 ? fmt::format("; checked every {} evaluations", choice.fmm.check_every)
                                       : std::string("; never checked");
  if (!choice.reason.empty()) text += "; " + choice.reason;
  return text;
}

std::vector<KeyProblem> find_mobility_problems(const SceneConfig& scene) {
  const HydrodynamicsConfig& config = scene.hydrodynamics;
  if (config.method == SumMethod::direct) return {};
  const FmmOptions options = make_fmm_options(scene);
  const Size size = measure_size(scene);
  const bool falls_back =
      config.method == SumMethod::automatic && config.precision != Precision::in_single && needs_direct_sum(options);
  std::vector<KeyProblem> problems;
  for (const OptionProblem& problem : find_fmm_problems(options))
    if (!(falls_back && problem.option == "tolerance"))
      problems.push_back({"hydrodynamics." + problem.option, "hydrodynamics." + problem.message});
  if (options.far_field == FarField::regularized && !size.has_equal_blobs)
    problems.push_back(
        {"hydrodynamics.far_field",
         "hydrodynamics.far_field = \"regularized\" needs one blob for all fibers; \"harmonic\" does not"});
  if (scene.placement.kind != PlacementKind::as_written) return problems;  // where its nodes will be is not known yet
  if (const std::string lack = find_lack_of_far_field(options, size);
      config.method == SumMethod::fmm && problems.empty() && !lack.empty())
    problems.push_back(
        {"hydrodynamics.tolerance", "hydrodynamics.tolerance: " + lack + "; raise it, or use method = \"direct\""});
  return problems;
}

}  // namespace skein
