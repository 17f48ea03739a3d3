#include "segment_passage.hpp"

#include <skein/fibers/segment_distance.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace skein {
namespace {

/// c[0] + c[1] s + c[2] s^2 + c[3] s^3
struct Cubic {
  double c[4] = {};
  double operator()(const double s) const { return c[0] + s * (c[1] + s * (c[2] + s * c[3])); }
};

double triple(const Vec3 a, const Vec3 b, const Vec3 c) { return dot(a, cross(b, c)); }

/// A vector that changes evenly.
struct Linear {
  Vec3 at_start, change;
};

Cubic triple(const Linear& a, const Linear& b, const Linear& c) {
  const Vec3 a0 = a.at_start, b0 = b.at_start, c0 = c.at_start, a1 = a.change, b1 = b.change, c1 = c.change;
  return {{triple(a0, b0, c0), triple(a1, b0, c0) + triple(a0, b1, c0) + triple(a0, b0, c1),
           triple(a1, b1, c0) + triple(a1, b0, c1) + triple(a0, b1, c1), triple(a1, b1, c1)}};
}

/// Times in [0, 1] between which the cubic only grows or only falls, with both ends.
std::vector<double> split_by_slope(const Cubic& cubic) {
  std::vector<double> times{0.0};
  // Slope 3 c3 s^2 + 2 c2 s + c1, its roots by the formula that does not lose digits.
  const double a = 3.0 * cubic.c[3], b = cubic.c[2], c = cubic.c[1];
  if (const double square = b * b - a * c; square >= 0.0) {
    const double q = -(b + std::copysign(std::sqrt(square), b));
    for (const auto [numerator, denominator] : {std::pair(q, a), std::pair(c, q)})
      if (std::abs(numerator) < std::abs(denominator) && numerator * denominator > 0.0)
        times.push_back(numerator / denominator);
  }
  times.push_back(1.0);
  std::sort(times.begin(), times.end());
  return times;
}

double find_root(const Cubic& cubic, double low, double high) {
  const bool rises = cubic(low) < 0.0;
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high))
    ((cubic(middle) < 0.0) == rises ? low : high) = middle;
  return high;
}

/// True where one plane holds both pieces at a moment, to a distance.
bool is_planar_at(const MovingPiece& p, const MovingPiece& q, const double share, const double distance) {
  constexpr double rounding = 1e-15;
  const Vec3 origin = p.first(share), along_p = p.last(share) - origin, along_q = q.last(share) - q.first(share),
             between = q.first(share) - origin;
  const double length_p = norm(along_p), length_q = norm(along_q), apart = norm(between);
  const double noise = rounding * (norm(origin) + length_p + length_q + apart) *
                       (length_p * length_q + length_p * apart + length_q * apart);
  return std::abs(triple(along_p, along_q, between)) <= std::max(distance * norm(cross(along_p, along_q)), noise);
}

}  // namespace

double compute_distance(const MovingPiece& p, const MovingPiece& q, const double share) {
  return compute_segment_distance(p.first(share), p.last(share), q.first(share), q.last(share));
}

PieceEncounter find_passages(const MovingPiece& p, const MovingPiece& q, const double meeting) {
  PieceEncounter encounter;
  encounter.is_planar = is_planar_at(p, q, 0.0, meeting) && is_planar_at(p, q, 1.0, meeting);
  if (encounter.is_planar) return encounter;
  const auto difference = [](const Vec3 a_before, const Vec3 b_before, const Vec3 a_after, const Vec3 b_after) {
    return Linear{b_before - a_before, (b_after - a_after) - (b_before - a_before)};
  };
  const Cubic volume = triple(difference(p.first_before, p.last_before, p.first_after, p.last_after),
                              difference(q.first_before, q.last_before, q.first_after, q.last_after),
                              difference(p.first_before, q.first_before, p.first_after, q.first_after));
  const auto times = split_by_slope(volume);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const bool was_below = volume(times[i - 1]) < 0.0, is_below = volume(times[i]) < 0.0;
    if (was_below == is_below) continue;
    if (compute_distance(p, q, find_root(volume, times[i - 1], times[i])) > meeting) continue;
    (was_below ? encounter.rises : encounter.falls) = true;
  }
  return encounter;
}

// No end of a piece moves faster, seen from an end of the other, than the fastest pair: a step that such a pair could
// take without coming too near passes over nothing.
bool come_near(const MovingPiece& p, const MovingPiece& q, const double distance) {
  double fastest = 0.0;
  for (const Vec3 moved_p : {p.first_after - p.first_before, p.last_after - p.last_before})
    for (const Vec3 moved_q : {q.first_after - q.first_before, q.last_after - q.last_before})
      fastest = std::max(fastest, norm(moved_p - moved_q));
  for (double share = 0.0; share <= 1.0;) {
    const double now = compute_distance(p, q, share);
    if (now <= distance) return true;
    if (fastest == 0.0) return false;
    share += (now - 0.5 * distance) / fastest;
  }
  return compute_distance(p, q, 1.0) <= distance;
}

}  // namespace skein
