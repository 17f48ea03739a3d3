#pragma once

#include <skein/core/far_field.hpp>
#include <skein/core/kernel_path.hpp>
#include <skein/core/precision.hpp>

#include <string>
#include <vector>

namespace skein {

/// Where velocities are asked for.
enum class FmmTargets {
  at_sources,  ///< near sources make up most of each velocity
  apart,       ///< velocities may be all far field, with all of its error
};

/// What a user may ask of the fast multipole method; 0 leaves a choice to the tables.
struct FmmOptions {
  double tolerance = 1e-4;  ///< relative error of all velocities together (2-norm)
  FarField far_field = FarField::harmonic;
  int order = 0;                ///< p, points per edge of the surfaces, 4 .. 16
  int leaf_size = 0;            ///< nodes per leaf aimed at
  double min_half_width = 0.0;  ///< of a leaf, length; checked against the floor law
  Precision precision = Precision::automatic;
  bool direct_when_cheaper = false;  ///< sum directly where the lists show that this costs less
  bool stokes_part_only = false;     ///< stokeslet: feed the far field S_0 + (eps^2 / 4) Laplacian S_0 instead of S_eps
  /// Harmonic field: degree of the polynomials that carry the blobs' term of eps^4 between boxes, 1 .. 8; 0 leaves it
  /// to the tolerance and the tree, no_tail leaves the term out.
  int tail_degree = 0;
  static constexpr int no_tail = -1;
  double singular_cutoff = 0.0;  ///< of the surface operators, relative; a raised order has its own
  int check_every = 0;           ///< evaluations between checks against direct sums; 0: no checks
  int n_checked_targets = 64;
  FmmTargets other_targets = FmmTargets::apart;  ///< where targets lie that are not the sources' own array
  OnMiss on_miss = OnMiss::raise_order;
  KernelPath path = KernelPath::automatic;
};

/// What an evaluation uses.
struct FmmPlan {
  int order = 6;
  int rank = 121;  ///< about, of the operators
  double singular_cutoff = 0.0;
  double transfer_tolerance = 0.0;  ///< that transfers may lose by being taken apart, relative
  int leaf_size = 64;               ///< along a line; a cloud's leaves hold more
  double min_half_width = 0.0;      ///< length
  bool near_in_single = false;      ///< allowed; see single_precision_error
  bool far_in_single = false;
  double expected_error = 0.0;    ///< by the order: bound from the table, for any arrangement of nodes
  int tail_degree = 0;            ///< of the polynomials that carry the blobs' term of eps^4; 0: it is left out
  double plain_half_width = 0.0;  ///< from which leaves do not need them, length
  double blob_error = 0.0;        ///< in the smallest leaves, by the floor law
};

/// What is wrong with one option, in words that begin with its name and value.
struct OptionProblem {
  std::string option;
  std::string message;
};

/// Where the options contradict each other or ask for what cannot be delivered, whatever the nodes.
std::vector<OptionProblem> find_fmm_problems(const FmmOptions& options);

/// @throws Error(scene_error) with the first of these problems.
void check_fmm_options(const FmmOptions& options);

/// The cheapest plan that meets the tolerance, from a table measured with perf/bench_fmm: the same on every machine, so
/// that a run can be repeated.
/// @param max_blob      the largest regularization length among the sources, length
/// @param raised_order  an order that a check found necessary; 0: none
/// @throws Error(scene_error) where none meets it, or where what is set by hand does not.
FmmPlan choose_fmm_plan(const FmmOptions& options, double max_blob, int raised_order,
                        FmmTargets targets = FmmTargets::at_sources);

/// Far field, order, leaves, precision, expected error: one line.
std::string describe_fmm_plan(const FmmOptions& options, const FmmPlan& plan);

/// Half-width below which leaves do not meet the tolerance, because of the blobs, length.
double smallest_half_width(const FmmOptions& options, double max_blob);

/// True where no plan reaches the tolerance and only direct sums do.
bool needs_direct_sum(const FmmOptions& options, FmmTargets targets = FmmTargets::at_sources);

/// Error between the nearest well-separated boxes that blobs cause in the harmonic far field: 0.011 (eps /
/// half-width)^4, or with the term of eps^4 to polynomials of a degree, what these miss and 0.002 (eps / half-width)^6.
double harmonic_floor(double blob, double half_width, int tail_degree = 0);

/// Bound of what single precision costs in the near field of leaves of this size.
double single_precision_error(double min_blob, double half_width);

}  // namespace skein
