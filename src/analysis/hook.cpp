#include <skein/analysis/hook.hpp>

#include <cmath>

namespace skein {

std::optional<Hook> find_hook(const std::span<const Vec3> centreline, const std::span<const double> arclength,
                              const std::span<const double> curvature, const FiberEnd end, const double least_turning) {
  // A slighter bend between the end and the hook is passed over.
  const auto bends = find_bends(arclength, curvature, least_turning);
  if (bends.empty()) return std::nullopt;
  Hook hook;
  hook.bend = end == FiberEnd::first ? bends.front() : bends.back();
  const int peak = hook.bend.peak;
  hook.arclength = end == FiberEnd::first ? arclength[peak] : arclength.back() - arclength[peak];
  // The middle section, to rounding, is in both halves.
  constexpr double half_with_rounding = 0.5 * (1.0 + 1e-9);
  if (hook.arclength > half_with_rounding * arclength.back()) return std::nullopt;

  const double half = 0.5 * std::abs(curvature[peak]);
  int first = peak, last = peak;
  while (first > hook.bend.first && std::abs(curvature[first - 1]) >= half) --first;
  while (last < hook.bend.last && std::abs(curvature[last + 1]) >= half) ++last;
  hook.circle = fit_circle(centreline.subspan(first, last - first + 1));
  return hook;
}

}  // namespace skein
