#include <skein/fibers/tube_overlap.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace skein {
namespace {

constexpr double rounding = 1e-12;
constexpr int n_iterations_allowed = 200;  ///< a few usually; a plane that is not found by then is not there

Vec3 find_farthest(const SectionPose& section, const double radius, const Vec3 direction) {
  const Vec3 along = section.axes.along;
  Vec3 inside = direction - dot(direction, along) * along;
  inside = inside - dot(inside, along) * along;  // again: of a direction along the axis only rounding is left
  const double length = norm(inside);
  return length > rounding * norm(direction) ? section.center + (radius / length) * inside : section.center;
}

/// The point of a piece that lies farthest in a direction.
Vec3 find_farthest(const TubePiece& piece, const Vec3 direction) {
  const Vec3 first = find_farthest(piece.first, piece.radius, direction);
  const Vec3 last = find_farthest(piece.last, piece.radius, direction);
  return dot(first, direction) >= dot(last, direction) ? first : last;
}

/// Some points of the difference of two pieces, at most four.
struct Simplex {
  std::array<Vec3, 4> point;
  int n = 0;
};

/// Solves the first n of three equations by elimination. @returns false where they are singular
bool solve(std::array<std::array<double, 4>, 3> rows, const int n, std::array<double, 3>& solution) {
  for (int c = 0; c < n; ++c) {
    int pivot = c;
    for (int r = c + 1; r < n; ++r)
      if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
    std::swap(rows[c], rows[pivot]);
    if (!(std::abs(rows[c][c]) > 0.0)) return false;
    for (int r = c + 1; r < n; ++r)
      for (int k = 3; k >= c; --k) rows[r][k] -= rows[r][c] / rows[c][c] * rows[c][k];
  }
  for (int c = n - 1; c >= 0; --c) {
    solution[c] = rows[c][3];
    for (int k = c + 1; k < n; ++k) solution[c] -= rows[c][k] * solution[k];
    solution[c] /= rows[c][c];
  }
  return true;
}

/// The point nearest to the origin on the flat through all points of a simplex, if it lies between them.
bool project(const Simplex& simplex, Vec3& nearest) {
  const Vec3 base = simplex.point[0];
  const int n = simplex.n - 1;
  std::array<std::array<double, 4>, 3> rows{};
  for (int r = 0; r < n; ++r) {
    const Vec3 edge = simplex.point[r + 1] - base;
    for (int c = 0; c < n; ++c) rows[r][c] = dot(edge, simplex.point[c + 1] - base);
    rows[r][3] = -dot(edge, base);
  }
  std::array<double, 3> share{};
  if (!solve(rows, n, share)) return false;
  double rest = 1.0;
  nearest = base;
  for (int i = 0; i < n; ++i) {
    if (share[i] < 0.0) return false;
    rest -= share[i];
    nearest = nearest + share[i] * (simplex.point[i + 1] - base);
  }
  return rest >= 0.0;
}

/// Leaves only the points between which the simplex's nearest point to the origin lies. @returns that point
Vec3 reduce(Simplex& simplex) {
  Simplex best;
  Vec3 nearest;
  double least = -1.0;
  for (int set = 1; set < 1 << simplex.n; ++set) {
    Simplex part;
    for (int i = 0; i < simplex.n; ++i)
      if ((set >> i & 1) != 0) part.point[part.n++] = simplex.point[i];
    Vec3 found;
    if (!project(part, found)) continue;
    const double distance = dot(found, found);
    if (least >= 0.0 && distance >= least) continue;
    least = distance;
    nearest = found;
    best = part;
  }
  simplex = best;
  return nearest;
}

double measure_size(const TubePiece& piece) {
  return norm(piece.last.center - piece.first.center) + 2.0 * piece.radius;
}

}  // namespace

bool are_apart(const TubePiece& a, const TubePiece& b) {
  const double smallest = rounding * (measure_size(a) + measure_size(b));
  Simplex simplex;
  Vec3 nearest = a.first.center - b.first.center;
  for (int iteration = 0; iteration < n_iterations_allowed && norm(nearest) > smallest; ++iteration) {
    const Vec3 next = find_farthest(a, -nearest) - find_farthest(b, nearest);
    if (dot(nearest, next) > smallest * norm(nearest)) return true;
    simplex.point[simplex.n++] = next;
    nearest = reduce(simplex);
    if (simplex.n == 4) return false;  // the origin is inside
  }
  return false;
}

std::vector<TubePiece> list_tube_pieces(const std::vector<SectionPose>& poses, const double radius) {
  const double length = norm(poses.back().center - poses.front().center);
  const bool is_straight = std::all_of(poses.begin(), poses.end(), [&](const SectionPose& pose) {
    return norm(cross(pose.center - poses.front().center, poses.front().axes.along)) <= rounding * length &&
           norm(cross(pose.axes.along, poses.front().axes.along)) <= rounding;
  });
  if (is_straight) return {{poses.front(), poses.back(), radius}};
  std::vector<TubePiece> pieces;
  for (std::size_t s = 1; s < poses.size(); ++s) pieces.push_back({poses[s - 1], poses[s], radius});
  return pieces;
}

}  // namespace skein
