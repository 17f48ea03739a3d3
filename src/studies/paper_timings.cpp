#include "studies/paper_timings.hpp"

#include <skein/fibers/fiber.hpp>
#include <skein/io/array_file.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "runs/evaluation_time.hpp"
#include "studies/paper_scenes.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace skein {
namespace {

constexpr double viscosity = 1.0;  // of the paper

/// Forces without a direction in common, of one size.
std::vector<Vec3> make_forces(const std::size_t n) {
  std::vector<Vec3> force;
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<double>(i);
    force.push_back({std::cos(1.3 * k), std::sin(2.1 * k), std::cos(0.7 * k)});
  }
  return force;
}

double time_sums(Mobility& mobility, const Sources& sources, const Vectors& velocity) {
  return time_calls([&] { mobility.add_velocity(sources, sources.position, velocity); });
}

}  // namespace

std::vector<SumTiming> time_paper_sums() {
  FmmOptions options;
  options.tolerance = 1e-4;
  FmmMobility fmm(viscosity, options);
  DirectMobility direct(viscosity, Precision::in_double);
  std::vector<SumTiming> timings;
  for (const int sections : {40, 80, 160, 301, 536, 900, 1313}) {
    const auto fibers = make_fibers(make_paper_scene(sections, 1.0).fibers);
    const auto nodes = make_surface_nodes(fibers);
    const Sources sources{to_device("skein::time_paper_sums::position", nodes),
                          to_device("skein::time_paper_sums::force", make_forces(nodes.size())),
                          to_device("skein::time_paper_sums::blob", make_blobs(fibers))};
    const Vectors velocity("skein::time_paper_sums::velocity", nodes.size());
    SumTiming timing;
    timing.n_nodes = static_cast<int>(nodes.size());
    timing.direct_seconds = time_sums(direct, sources, velocity);
    timing.fmm_seconds = time_sums(fmm, sources, velocity);
    timing.fmm_error = fmm.measure_error(sources, sources.position, timing.n_nodes);
    timings.push_back(timing);
  }
  return timings;
}

double find_crossover(const std::vector<SumTiming>& timings) {
  const auto speedup = [](const SumTiming& t) { return t.direct_seconds / t.fmm_seconds; };
  std::size_t first = timings.size();
  while (first > 0 && speedup(timings[first - 1]) >= 1.0) --first;
  if (first == timings.size()) return std::numeric_limits<double>::quiet_NaN();
  if (first == 0) return timings.front().n_nodes;
  const SumTiming &below = timings[first - 1], &above = timings[first];
  const double share = std::log(1.0 / speedup(below)) / std::log(speedup(above) / speedup(below));
  return below.n_nodes * std::pow(static_cast<double>(above.n_nodes) / below.n_nodes, share);
}

void write_timings_csv(const std::filesystem::path& path, const std::vector<SumTiming>& timings) {
  std::vector<NamedArray> columns{
      {"nodes", "", {}, {}}, {"direct", "s", {}, {}}, {"fmm", "s", {}, {}}, {"fmm_error", "", {}, {}}};
  for (const SumTiming& timing : timings) {
    columns[0].values.push_back(timing.n_nodes);
    columns[1].values.push_back(timing.direct_seconds);
    columns[2].values.push_back(timing.fmm_seconds);
    columns[3].values.push_back(timing.fmm_error);
  }
  write_csv(path, columns);
}

}  // namespace skein
