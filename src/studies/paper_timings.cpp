#include "studies/paper_timings.hpp"

#include <skein/io/array_file.hpp>

#include "runs/sum_timing.hpp"
#include "studies/paper_scenes.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace skein {
std::vector<SumTiming> time_paper_sums() {
  std::vector<FiberConfig> fibers;
  for (const int sections : {40, 80, 160, 301, 536, 900, 1313})
    fibers.push_back(make_paper_scene(sections, 1.0).fibers.front());
  return time_sums(fibers, /*tolerance=*/1e-4);
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
