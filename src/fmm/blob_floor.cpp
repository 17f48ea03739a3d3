#include "blob_floor.hpp"

#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace skein {
namespace {

/// What is left of the term of eps^4, by degree, over ratio^4, and the term of eps^6, over ratio^6. For 250 sources and
/// as many targets anywhere in their boxes the largest were 0.0039, 0.0014, 6.0e-4, 2.5e-4, 9.2e-5, 3.5e-5, 1.4e-5,
/// 5.5e-6 and 1.9e-6 of eps^4, and 5.7e-4 of eps^6, for random and aligned forces; forces with no sum exert less
/// velocity there, of which the higher degrees miss more, up to seven times.
constexpr double harmonic_factors[] = {0.011, 5e-3, 2.5e-3, 1.2e-3, 5e-4, 2.2e-4, 1e-4, 4e-5, 1.6e-5};
constexpr double next_factor = 0.002;
constexpr int most_degree = static_cast<int>(std::size(harmonic_factors)) - 1;

double fourth_power_factor(const FmmOptions& options, const int degree) {
  switch (options.far_field) {
    case FarField::harmonic:
      return harmonic_factors[degree];
    case FarField::stokeslet:
      return options.stokes_part_only ? harmonic_factors[0] : 0.1;
    case FarField::regularized:
      return 0.05;
  }
  throw Error(ExitCode::internal, "fourth_power_factor knows no such far field");
}

}  // namespace

bool is_tail_degree(const int degree) { return degree >= FmmOptions::no_tail && degree <= most_degree; }

double blob_floor(const FmmOptions& options, const int degree, const double ratio) {
  const double left = fourth_power_factor(options, degree) * std::pow(ratio, 4);
  return degree == 0 ? left : left + next_factor * std::pow(ratio, 6);
}

double largest_blob_ratio(const FmmOptions& options, const int degree, const double allowed) {
  double ratio = std::pow(allowed / fourth_power_factor(options, degree), 0.25);
  if (degree == 0) return ratio;
  // Newton's method from above, where the floor is convex.
  for (int step = 0; step < 60; ++step) {
    const double fourth = fourth_power_factor(options, degree) * std::pow(ratio, 4);
    const double sixth = next_factor * std::pow(ratio, 6);
    ratio -= ratio * (fourth + sixth - allowed) / (4.0 * fourth + 6.0 * sixth);
  }
  return ratio;
}

int choose_tail_degree(const FmmOptions& options, const double allowed) {
  if (options.far_field != FarField::harmonic || options.tail_degree == FmmOptions::no_tail) return 0;
  if (options.tail_degree > 0) return options.tail_degree;
  int degree = 2;
  while (degree < most_degree &&
         largest_blob_ratio(options, degree + 1, allowed) > 1.15 * largest_blob_ratio(options, degree, allowed))
    ++degree;
  return degree;
}

double harmonic_floor(const double blob, const double half_width, const int tail_degree) {
  return blob_floor({}, tail_degree, blob / half_width);
}

}  // namespace skein
