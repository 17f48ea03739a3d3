#include "app/paper_timings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <skein/core/stopwatch.hpp>
#include <skein/hydro/direct_mobility.hpp>
#include <skein/hydro/fmm_mobility.hpp>
#include <skein/io/array_file.hpp>
#include <skein/scene/fiber.hpp>
#include <string>
#include <utility>

#include "app/paper_scenes.hpp"

namespace skein {
namespace {

constexpr double viscosity = 1.0;  // of the paper
constexpr int n_repeats = 5;

/// Forces without a direction in common, of one size.
std::vector<Vec3> make_forces(const std::size_t n) {
  std::vector<Vec3> force;
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<double>(i);
    force.push_back({std::cos(1.3 * k), std::sin(2.1 * k), std::cos(0.7 * k)});
  }
  return force;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median of some sums after a first one, which builds what is kept; the last sum stays in `velocity`.
double time_sums(Mobility& mobility, const Sources& sources, const Vectors& velocity) {
  std::vector<double> seconds;
  for (int repeat = 0; repeat <= n_repeats; ++repeat) {
    Kokkos::deep_copy(velocity, 0.0);
    const auto start = WallClock::now();
    mobility.add_velocity(sources, sources.position, velocity);
    Kokkos::fence();
    if (repeat > 0) seconds.push_back(seconds_since(start));
  }
  return median(std::move(seconds));
}

double compare(const std::vector<Vec3>& got, const std::vector<Vec3>& exact) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    difference += dot(got[i] - exact[i], got[i] - exact[i]);
    size += dot(exact[i], exact[i]);
  }
  return std::sqrt(difference / size);
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
    const auto exact = to_host(ConstVectors(velocity));
    timing.fmm_seconds = time_sums(fmm, sources, velocity);
    timing.fmm_error = compare(to_host(ConstVectors(velocity)), exact);
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
