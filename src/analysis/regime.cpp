#include <skein/analysis/regime.hpp>
#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

const char* name_of(const Regime regime) {
  switch (regime) {
    case Regime::tumble:
      return "tumble";
    case Regime::c_shape:
      return "C";
    case Regime::s_shape:
      return "S";
    case Regime::snake:
      return "snake";
    case Regime::coil:
      return "coil";
    case Regime::three_dimensional:
      break;
  }
  return "three-dimensional";
}

Regime classify_shape(const Shape& shape, const double radius, const RegimeLimits& limits) {
  if (shape.out_of_plane > limits.out_of_plane * radius) return Regime::three_dimensional;
  if (shape.total_turning > limits.coil) return Regime::coil;
  int n_bends = 0;
  for (const Bend& bend : shape.bends) {
    const double turning = std::abs(bend.turning);
    const double from_end = std::min(bend.place, shape.length - bend.place);
    if (turning >= limits.folded || (turning >= limits.hook && from_end <= limits.end_share * shape.length))
      return Regime::snake;
    if (turning >= limits.bend) ++n_bends;
  }
  if (n_bends == 0) return Regime::tumble;
  return n_bends == 1 ? Regime::c_shape : Regime::s_shape;
}

std::vector<RegimeChange> find_regime_changes(const std::span<const double> time, const std::span<const Regime> regime,
                                              const double least_duration) {
  SKEIN_REQUIRE(time.size() == regime.size(), "one regime for each time");
  std::vector<RegimeChange> changes;
  for (std::size_t i = 0; i < regime.size();) {
    std::size_t end = i;
    while (end < regime.size() && regime[end] == regime[i]) ++end;
    const bool lasts = end == regime.size() || time[end] - time[i] >= least_duration;
    if (changes.empty() || (lasts && changes.back().regime != regime[i])) changes.push_back({time[i], regime[i]});
    i = end;
  }
  return changes;
}

Regime classify_run(const std::span<const Regime> regime) {
  Regime reached = Regime::tumble;
  for (std::size_t i = 1; i < regime.size(); ++i) reached = std::max(reached, std::min(regime[i - 1], regime[i]));
  return reached;
}

}  // namespace skein
