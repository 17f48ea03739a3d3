#include "fmm/fmm_translations.hpp"
#include "fmm/host_scratch.hpp"

#include <algorithm>

// The last pass: everything that ends at the targets of a leaf, so that their velocities are written once.

namespace skein {
namespace {

using simd::Pack;

constexpr int near_tile = 128;  // sources in the first cache at once

/// Targets of a task in a box's units or in units of length, from the box's centre.
template <class Real>
struct LeafTargets {
  alignas(simd::bytes) Real x[3][task_targets];
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
  alignas(simd::bytes) double velocity[3][task_targets];
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

  void load(const SortedNodes& nodes, const int first, const int count, const Vec3 center) {
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
void add_near_field(const SortedNodes& nodes, const std::span<const IndexRange> runs, const Vec3 center,
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

template <int packs, class Real, class Field>
void add_densities(const Field& field, const OperatorSet<Real>& operators, const Real size, const Real* density,
                   const LeafTargets<Real>& targets, const int first, const double scale, LeafSum& sum) {
  constexpr int width = simd::width<Real>;
  Pack<Real> x[packs][3], u[packs][3] = {};
  for (int k = 0; k < packs; ++k)
    for (int c = 0; c < 3; ++c) x[k][c] = simd::load_pack(&targets.x[c][first + k * width]);
  for (int j = 0; j < operators.n_surface; ++j) {
    const Real point[3] = {size * operators.surface(j, 0), size * operators.surface(j, 1),
                           size * operators.surface(j, 2)};
    Real q[Field::n_planes];
    for (int plane = 0; plane < Field::n_planes; ++plane) q[plane] = density[plane * operators.n_padded + j];
    SKEIN_UNROLL
    for (int k = 0; k < packs; ++k) field.add_density(x[k][0], x[k][1], x[k][2], point, q, u[k]);
  }
  for (int k = 0; k < packs; ++k) add_lanes<Real>(u[k], first + k * width, scale, sum);
}

/// Velocity of the densities on a box's surface, at targets in that box's units.
template <class Real, class Field>
void add_surface_velocity(const Field& field, const OperatorSet<Real>& operators, const PaddedMatrix<Real>& to_density,
                          const Real* coefficient, const int stride, const double size, const double half_width,
                          const LeafTargets<Real>& targets, Real* density, LeafSum& sum) {
  constexpr int width = simd::width<Real>;
  to_density.apply(coefficient, stride, Field::n_columns, density, to_density.n_rows);
  int first = 0;
  for (; first + 2 * width <= targets.n_padded(); first += 2 * width)
    add_densities<2>(field, operators, static_cast<Real>(size), density, targets, first, 1.0 / half_width, sum);
  for (; first < targets.n_padded(); first += width)
    add_densities<1>(field, operators, static_cast<Real>(size), density, targets, first, 1.0 / half_width, sum);
}

}  // namespace

std::vector<TargetTask> make_target_tasks(const HostOctree& tree) {
  std::vector<TargetTask> tasks;
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) {
    const IndexRange targets = tree.target_leaf(leaf).targets;
    for (int i = 0; i < targets.count; i += task_targets)
      tasks.push_back({leaf, {targets.first + i, math::smaller(task_targets, targets.count - i)}});
  }
  return tasks;
}

template <class Near, class Real, class Field>
void add_leaf_velocities(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                         const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients,
                         const NearField& near, const std::vector<TargetTask>& tasks, const HostVectors& velocity) {
  const auto add = [&](const int t) {
    const TargetTask task = tasks[static_cast<std::size_t>(t)];
    const int b = tree.target_leaves(task.leaf);
    const Box& box = tree.box(b);
    const Vec3 center = tree.cube.center(box);
    LeafSum sum = {};
    if (near.velocity.extent(0) > 0)
      for (int c = 0; c < 3; ++c) {
        const double* velocity = &near.velocity(static_cast<std::ptrdiff_t>(c) * near.n_packed +
                                                near.leaf_first[task.leaf] + task.targets.first - box.targets.first);
        for (int i = 0; i < task.targets.count; ++i) sum.velocity[c][i] = velocity[i];
      }
    const std::span<const IndexRange> runs = near.of_leaf(task.leaf);
    if (!runs.empty()) {
      LeafTargets<Near> targets;
      targets.load(nodes.target, task.targets, center, 1.0);
      add_near_field<Near>(nodes, runs, center, targets, sum);
    }
    const bool has_far = box.level >= first_far_level;
    if (has_far || !tree.w_list.of(task.leaf).empty()) {
      const int level = math::larger(box.level, first_far_level);
      const auto& operators = *levels[static_cast<std::size_t>(level)];
      LeafTargets<Real> targets;
      const HostScratch<Real> density(Field::n_planes * operators.n_padded * 2);
      if (has_far) {
        const double half_width = tree.half_width(box.level);
        targets.load(nodes.target, task.targets, center, half_width);
        add_surface_velocity(field.at(half_width), operators, operators.target_density,
                             coefficients.target.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size,
                             coefficients.stride, outer_surface, half_width, targets, density.get(), sum);
      }
      for (const int w : tree.w_list.of(task.leaf)) {
        const Box& fine = tree.box(w);
        const auto& fine_operators = *levels[static_cast<std::size_t>(fine.level)];
        const double half_width = tree.half_width(fine.level);
        targets.load(nodes.target, task.targets, tree.cube.center(fine), half_width);
        add_surface_velocity(field.at(half_width), fine_operators, fine_operators.source_density,
                             coefficients.source.data() + static_cast<std::ptrdiff_t>(w) * coefficients.box_size,
                             coefficients.stride, inner_surface, half_width, targets, density.get(), sum);
      }
    }
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < task.targets.count; ++i)
        velocity(tree.target_order()(task.targets.first + i), c) += sum.velocity[c][i];
  };
  Kokkos::parallel_for(
      "skein::add_leaf_velocities",
      Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>(HostSpace(), 0, static_cast<int>(tasks.size())),
      add);
}

#define SKEIN_INSTANTIATE(Near, Real, Field)                                                             \
  template void add_leaf_velocities<Near, Real, Field>(                                                  \
      const HostOctree&, const SortedNodes&, const Field&, const std::vector<const OperatorSet<Real>*>&, \
      const Coefficients<Real>&, const NearField&, const std::vector<TargetTask>&, const HostVectors&);
#define SKEIN_INSTANTIATE_FIELD(Field)     \
  SKEIN_INSTANTIATE(double, double, Field) \
  SKEIN_INSTANTIATE(double, float, Field)  \
  SKEIN_INSTANTIATE(float, float, Field)
SKEIN_INSTANTIATE_FIELD(HarmonicField)
SKEIN_INSTANTIATE_FIELD(StokesletField)
SKEIN_INSTANTIATE_FIELD(RegularizedField)

}  // namespace skein
