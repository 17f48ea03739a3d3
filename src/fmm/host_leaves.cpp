#include "fmm/host_leaves.hpp"

#include "fmm/host_workers.hpp"
#include "fmm/leaf_sums.hpp"

#include <algorithm>

// The last pass: everything that ends at the targets of a leaf, so that their velocities are written once.

namespace skein {
namespace {

constexpr int near_tile = 128;  // sources in the first cache at once

/// Targets of a part in a box's units or in units of length, from the box's centre.
template <class Real>
struct LeafTargets {
  alignas(simd::bytes) Real x[3][host_part_targets];
  int n = 0;

  int n_padded() const { return padded<Real>(n); }
  void load(const HostVectors& target, const IndexRange run, const Vec3 center, const double half_width) {
    n = run.count;
    const double origin[3] = {center.x, center.y, center.z}, to_units = 1.0 / half_width;
    for (int c = 0; c < 3; ++c) {
      const double* from = &target(run.first, c);
      for (int i = 0; i < n; ++i) x[c][i] = static_cast<Real>(to_units * (from[i] - origin[c]));
      for (int i = n; i < n_padded(); ++i) x[c][i] = x[c][n - 1];
    }
  }
};

struct LeafSum {
  alignas(simd::bytes) double velocity[3][host_part_targets];
};

template <class Real>
void add_lanes(const Pack<Real> (&u)[3], const int first, const double scale, LeafSum& sum) {
  for (int c = 0; c < 3; ++c)
    for (int lane = 0; lane < simd::width<Real>; ++lane)
      sum.velocity[c][first + lane] += scale * static_cast<double>(u[c][lane]);
}

template <class Real>
struct NearTile {
  alignas(simd::bytes) Real y[3][near_tile], force[3][near_tile], blob_squared[near_tile];
  int n = 0;

  void load(const SortedNodes<HostSpace>& nodes, const int first, const int count, const Vec3 center) {
    n = count;
    const double origin[3] = {center.x, center.y, center.z};
    for (int c = 0; c < 3; ++c) {
      const double* from = &nodes.position(first, c);
      const double* force_of = &nodes.force(first, c);
      for (int i = 0; i < n; ++i) y[c][i] = static_cast<Real>(from[i] - origin[c]);
      for (int i = 0; i < n; ++i) force[c][i] = static_cast<Real>(force_of[i]);
    }
    const double* blob = &nodes.blob(first);
    for (int i = 0; i < n; ++i) blob_squared[i] = static_cast<Real>(blob[i] * blob[i]);
  }
};

template <int packs, class Real>
void add_near_tile(const LeafTargets<Real>& targets, const int first, const NearTile<Real>& sources, LeafSum& sum) {
  constexpr int width = simd::width<Real>;
  Pack<Real> x[packs][3], u[packs][3] = {};
  for (int k = 0; k < packs; ++k)
    for (int c = 0; c < 3; ++c) x[k][c] = simd::load_pack(&targets.x[c][first + k * width]);
  for (int s = 0; s < sources.n; ++s) {
    const Real fx = sources.force[0][s], fy = sources.force[1][s], fz = sources.force[2][s];
    const Real blob_squared = sources.blob_squared[s];
    SKEIN_UNROLL
    for (int k = 0; k < packs; ++k) {
      const Pack<Real> dx = x[k][0] - sources.y[0][s], dy = x[k][1] - sources.y[1][s], dz = x[k][2] - sources.y[2][s];
      const auto weight = regularized_stokeslet::weights(dx, dy, dz, blob_squared);
      regularized_stokeslet::add(weight, dx, dy, dz, fx, fy, fz, u[k][0], u[k][1], u[k][2]);
    }
  }
  for (int k = 0; k < packs; ++k) add_lanes<Real>(u[k], first + k * width, 1.0, sum);
}

/// U: every source of the runs, directly.
template <class Real>
void add_near_field(const SortedNodes<HostSpace>& nodes, const std::span<const IndexRange> runs, const Vec3 center,
                    const LeafTargets<Real>& targets, LeafSum& sum) {
  constexpr int width = simd::width<Real>;
  NearTile<Real> sources;
  for (const IndexRange& run : runs)
    for (int s = 0; s < run.count; s += near_tile) {
      sources.load(nodes, run.first + s, math::smaller(near_tile, run.count - s), center);
      int first = 0;
      for (; first + 2 * width <= targets.n_padded(); first += 2 * width)
        add_near_tile<2>(targets, first, sources, sum);
      for (; first < targets.n_padded(); first += width) add_near_tile<1>(targets, first, sources, sum);
    }
}

/// Targets of one leaf, or some of them where it has many, and what has been summed for them.
template <class Real, class Field>
struct HostPart {
  const Passes<HostSpace, Real, Field>& passes;
  IndexRange targets;
  HostScratch<Real>& density;
  LeafSum& sum;

  /// Velocity of the densities on a box's surface, from its coefficients.
  void add_surface(const LevelOperators<Real>& operators, const Matrix<Real>& to_density, const Real* coefficients,
                   const Real size, const Box& box) {
    const double half_width = passes.cube.half_width(box.level);
    multiply(to_density, coefficients, passes.coefficients.stride, Field::n_columns, density.data(), to_density.n_rows);
    LeafTargets<Real> at;
    at.load(passes.nodes.target, targets, passes.cube.center(box), half_width);
    constexpr int width = simd::width<Real>;
    const Field field = passes.field.at(half_width);
    int first = 0;
    for (; first + 2 * width <= at.n_padded(); first += 2 * width)
      add_to_targets<2>(field, operators, size, at, first, 1.0 / half_width);
    for (; first < at.n_padded(); first += width)
      add_to_targets<1>(field, operators, size, at, first, 1.0 / half_width);
  }

  void add_polynomials(const Real* coefficients, const Box& box) {
    const double half_width = passes.cube.half_width(box.level);
    LeafTargets<Real> at;
    at.load(passes.nodes.target, targets, passes.cube.center(box), half_width);
    for (int first = 0; first < at.n_padded(); first += simd::width<Real>) {
      Pack<Real> x[3], u[3] = {};
      for (int c = 0; c < 3; ++c) x[c] = simd::load_pack(&at.x[c][first]);
      add_tail_velocity<Real>(passes.field.degree, coefficients, x, u);
      add_lanes<Real>(u, first, 1.0 / half_width, sum);
    }
  }

 private:
  template <int packs>
  void add_to_targets(const Field& field, const LevelOperators<Real>& operators, const Real size,
                      const LeafTargets<Real>& at, const int first, const double scale) {
    constexpr int width = simd::width<Real>;
    Pack<Real> x[packs][3], u[packs][3] = {};
    for (int k = 0; k < packs; ++k)
      for (int c = 0; c < 3; ++c) x[k][c] = simd::load_pack(&at.x[c][first + k * width]);
    add_densities(field, operators, size, density.data(), {0, operators.n_surface}, x, u);
    for (int k = 0; k < packs; ++k) add_lanes<Real>(u[k], first + k * width, scale, sum);
  }
};

/// What is there already of the near field, and the rest of it.
template <class Near>
void add_near(const NearField& near, const SortedNodes<HostSpace>& nodes, const int leaf, const Box& box,
              const IndexRange part, const Vec3 center, LeafSum& sum) {
  if (near.velocity.extent(0) > 0)
    for (int c = 0; c < 3; ++c) {
      const double* there = &near.velocity(static_cast<std::ptrdiff_t>(c) * near.n_packed + near.leaf_first[leaf] +
                                           part.first - box.targets.first);
      for (int i = 0; i < part.count; ++i) sum.velocity[c][i] = there[i];
    }
  const std::span<const IndexRange> runs = near.of_leaf(leaf);
  if (runs.empty()) return;
  LeafTargets<Near> targets;
  targets.load(nodes.target, part, center, 1.0);
  add_near_field<Near>(nodes, runs, center, targets, sum);
}

}  // namespace

template <class Near, class Real, class Field>
void sum_leaf_velocities(const Passes<HostSpace, Real, Field>& passes, const NearField& near,
                         const LeafParts<HostSpace>& parts, const HostVectors& velocity) {
  for_tasks("skein::sum_leaf_velocities", parts.n_parts, [&](const int p) {
    const int leaf = parts.leaf(p), before = parts.place(p) * host_part_targets;
    const Box& box = passes.boxes(passes.target_leaves(leaf));
    const IndexRange part{box.targets.first + before, math::smaller(host_part_targets, box.targets.count - before)};
    LeafSum sum = {};
    if constexpr (!std::is_same_v<Field, TailField>)  // which comes after all else
      add_near<Near>(near, passes.nodes, leaf, box, part, passes.cube.center(box), sum);
    HostScratch<Real> density(math::larger(1, Field::n_planes * passes.levels.n_padded));
    HostPart<Real, Field> targets{passes, part, density, sum};
    add_expansions(targets, passes, leaf);
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < part.count; ++i) {
        double& to = velocity(passes.target_order(part.first + i), c);
        to = (std::is_same_v<Field, TailField> ? to : 0.0) + sum.velocity[c][i];
      }
  });
}

#define SKEIN_INSTANTIATE(Near, Real, Field)                                                                    \
  template void sum_leaf_velocities<Near, Real, Field>(const Passes<HostSpace, Real, Field>&, const NearField&, \
                                                       const LeafParts<HostSpace>&, const HostVectors&);
#define SKEIN_INSTANTIATE_FIELD(Field)     \
  SKEIN_INSTANTIATE(double, double, Field) \
  SKEIN_INSTANTIATE(double, float, Field)  \
  SKEIN_INSTANTIATE(float, float, Field)
SKEIN_INSTANTIATE_FIELD(HarmonicField)
SKEIN_INSTANTIATE(double, double, TailField)
SKEIN_INSTANTIATE(double, float, TailField)
SKEIN_INSTANTIATE_FIELD(StokesletField)
SKEIN_INSTANTIATE_FIELD(RegularizedField)
#undef SKEIN_INSTANTIATE_FIELD
#undef SKEIN_INSTANTIATE  // device builds read several of these sources as one

}  // namespace skein
