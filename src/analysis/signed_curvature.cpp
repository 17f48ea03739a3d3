#include <skein/analysis/centreline.hpp>
#include <skein/analysis/signed_curvature.hpp>
#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

std::vector<double> compute_arclength(const std::span<const Vec3> centreline) {
  std::vector<double> arclength(centreline.size(), 0.0);
  for (std::size_t s = 1; s < centreline.size(); ++s)
    arclength[s] = arclength[s - 1] + norm(centreline[s] - centreline[s - 1]);
  return arclength;
}

int choose_curvature_reach(const Fiber& fiber) {
  return std::max(1, static_cast<int>(std::lround(0.7 * fiber.config.radius / fiber.spacing())));
}

std::vector<double> compute_signed_curvature(const std::span<const Vec3> centreline, const int reach,
                                             const Vec3 normal) {
  std::vector<double> curvature = compute_curvature(centreline, reach);
  const int n = static_cast<int>(centreline.size());
  if (n < 3) return curvature;
  for (int s = 1; s < n - 1; ++s) {
    const int step = std::min({reach, s, n - 1 - s});
    const Vec3 turn = cross(centreline[s] - centreline[s - step], centreline[s + step] - centreline[s]);
    if (dot(turn, normal) < 0.0) curvature[s] = -curvature[s];
  }
  curvature.front() = curvature[1];
  curvature.back() = curvature[n - 2];
  return curvature;
}

std::vector<Bend> find_bends(const std::span<const double> arclength, const std::span<const double> curvature,
                             const double least_turning) {
  SKEIN_REQUIRE(arclength.size() == curvature.size(), "one arclength for each curvature");
  std::vector<Bend> bends;
  const int n = static_cast<int>(curvature.size());
  for (int first = 0; first < n;) {
    Bend bend{first, first, first, 0.0, 0.0};
    int s = first;
    for (; s < n && std::signbit(curvature[s]) == std::signbit(curvature[first]); ++s) {
      // Half of the distance between both neighbours: the trapezoidal rule.
      bend.turning += 0.5 * curvature[s] * (arclength[std::min(s + 1, n - 1)] - arclength[std::max(s - 1, 0)]);
      if (std::abs(curvature[s]) > std::abs(curvature[bend.peak])) bend.peak = s;
    }
    bend.last = s - 1;
    bend.place = arclength[bend.peak];
    first = s;
    if (std::abs(bend.turning) >= least_turning) bends.push_back(bend);
  }
  return bends;
}

double compute_total_turning(const std::span<const double> arclength, const std::span<const double> curvature) {
  double turning = 0.0;
  for (std::size_t s = 1; s < curvature.size(); ++s)
    turning += 0.5 * (std::abs(curvature[s]) + std::abs(curvature[s - 1])) * (arclength[s] - arclength[s - 1]);
  return turning;
}

}  // namespace skein
