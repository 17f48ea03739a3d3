// Which runs a sweep has.
#include <skein/core/error.hpp>
#include <skein/scene/sweep_file.hpp>

#include <fmt/format.h>

namespace skein {
namespace {

std::vector<std::size_t> find_axis_lengths(const SweepConfig& sweep) {
  std::vector<std::size_t> lengths(sweep.n_axes, 1);
  for (const SweepParameter& parameter : sweep.parameters) lengths[parameter.axis] = parameter.values.size();
  return lengths;
}

}  // namespace

std::size_t count_sweep_runs(const SweepConfig& sweep) {
  std::size_t n = 1;
  for (const std::size_t length : find_axis_lengths(sweep)) n *= length;
  return n;
}

std::vector<std::size_t> find_sweep_values(const SweepConfig& sweep, const std::size_t run) {
  const auto lengths = find_axis_lengths(sweep);
  std::vector<std::size_t> digits(sweep.n_axes);
  std::size_t rest = run;
  for (std::size_t axis = sweep.n_axes; axis-- > 0;) {
    digits[axis] = rest % lengths[axis];
    rest /= lengths[axis];
  }
  SKEIN_REQUIRE(rest == 0, fmt::format("run {} is one of the sweep's {}", run, count_sweep_runs(sweep)));
  std::vector<std::size_t> chosen;
  for (const SweepParameter& parameter : sweep.parameters) chosen.push_back(digits[parameter.axis]);
  return chosen;
}

std::vector<std::string> make_sweep_overrides(const SweepConfig& sweep, const std::size_t run) {
  std::vector<std::string> overrides = sweep.changes;
  const auto chosen = find_sweep_values(sweep, run);
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p)
    overrides.push_back(fmt::format("{}={}", sweep.parameters[p].key, sweep.parameters[p].values[chosen[p]].text));
  return overrides;
}

}  // namespace skein
