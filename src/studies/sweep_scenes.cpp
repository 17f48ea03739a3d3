#include "studies/sweep_scenes.hpp"

#include <skein/core/error.hpp>
#include <skein/io/read_file.hpp>

#include "runs/child_run.hpp"

#include <fmt/format.h>

#include <set>
#include <tuple>
#include <utility>

namespace skein {
namespace {

constexpr std::size_t most_problems = 100;

/// Collects what is wrong with the scenes of many runs.
class ProblemCollector {
 public:
  ProblemCollector(const std::filesystem::path& file, const SweepConfig& sweep)
      : file_(file.string()), sweep_(sweep), n_changes_(static_cast<int>(sweep.changes.size())) {}

  void add(const std::size_t run, const Problem& problem) {
    const int index = problem.where.override_index;
    if (!seen_.emplace(index < n_changes_ ? index : -1, problem.where.line, problem.where.column, problem.message)
             .second)
      return;
    Problem told = problem;
    if (index < 0)
      told.message += fmt::format("; first in run {} ({})", name_sweep_run(run), describe_sweep_run(sweep_, run));
    else if (index < n_changes_)
      told.where = make_origin(sweep_.change_places[index].first, sweep_.change_places[index].second);
    else
      told.where = find_origin(run, static_cast<std::size_t>(index - n_changes_));
    problems.push_back(std::move(told));
  }

  std::vector<Problem> problems;

 private:
  Origin make_origin(const int line, const int column) const { return {file_, line, column, -1}; }

  Origin find_origin(const std::size_t run, const std::size_t parameter) const {
    const SweepValue& value = sweep_.parameters[parameter].values[find_sweep_values(sweep_, run)[parameter]];
    return make_origin(value.line, value.column);
  }

  std::string file_;
  const SweepConfig& sweep_;
  int n_changes_;
  std::set<std::tuple<int, int, int, std::string>> seen_;
};

}  // namespace

SweepTexts read_sweep_texts(const std::filesystem::path& file, const SweepConfig& sweep) {
  return {read_file(file), read_file(sweep.scene), make_new_run(sweep.scene, make_sweep_overrides(sweep, 0)).start};
}

std::string describe_sweep_run(const SweepConfig& sweep, const std::size_t run) {
  const auto chosen = find_sweep_values(sweep, run);
  std::string text;
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p)
    text +=
        fmt::format("{}{}={}", p == 0 ? "" : ", ", sweep.parameters[p].key, sweep.parameters[p].values[chosen[p]].text);
  return text;
}

std::string name_sweep_run(const std::size_t run) { return fmt::format("{:05}", run); }

void check_sweep_scenes(const std::filesystem::path& file, const SweepConfig& sweep) {
  ProblemCollector collector(file, sweep);
  const std::size_t n_runs = count_sweep_runs(sweep);
  for (std::size_t run = 0; run < n_runs && collector.problems.size() < most_problems; ++run) {
    try {
      make_new_run(sweep.scene, make_sweep_overrides(sweep, run));
    } catch (const SceneError& error) {
      for (const Problem& problem : error.problems()) collector.add(run, problem);
    }
  }
  if (collector.problems.empty()) return;
  sort_problems(collector.problems);
  throw SceneError(file.string(), std::move(collector.problems), "sweep");
}

}  // namespace skein
