#pragma once

#include <skein/analysis/shape.hpp>

#include <numbers>
#include <span>
#include <vector>

namespace skein {

/// Shapes of a fiber in shear, in growing order of complexity (Forgacs and Mason 1959; Liu et al. 2018).
enum class Regime {
  tumble,             ///< straight but for slight bends
  c_shape,            ///< buckled with one bend
  s_shape,            ///< buckled with bends of opposite sense
  snake,              ///< an end folded back, in a U that moves along the fiber
  coil,               ///< more turning than two hooks have
  three_dimensional,  ///< in no plane: out of its own by more than a radius
};
const char* name_of(Regime regime);

/// From which a shape counts as something else; angles in radians. An S-turn folds its ends by less than half a turn
/// about places a quarter of the length from the ends; a snake turn begins as hooks at the very ends.
struct RegimeLimits {
  double bend = 0.6;                     ///< turning of a bend that is more than slight
  double folded = std::numbers::pi;      ///< turning of an end that is folded back, wherever the bend is
  double hook = 0.5 * std::numbers::pi;  ///< turning of a hook at the very end
  double end_share = 0.2;                ///< of the length: how far from the end that is
  double coil = 3.0 * std::numbers::pi;  ///< total turning: two hooks have less
  double out_of_plane = 1.0;             ///< in radii
};

Regime classify_shape(const Shape& shape, double radius, const RegimeLimits& limits = {});

/// From one regime to another.
struct RegimeChange {
  double time = 0.0;
  Regime regime = Regime::tumble;
};

/// Changes that last for at least `least_duration`; the first entry is the regime at the beginning.
std::vector<RegimeChange> find_regime_changes(std::span<const double> time, std::span<const Regime> regime,
                                              double least_duration = 0.0);

/// The most complex regime that a run shows in at least two moments: what it is called.
Regime classify_run(std::span<const Regime> regime);

}  // namespace skein
