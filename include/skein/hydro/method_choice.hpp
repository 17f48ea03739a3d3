#pragma once

#include <cstdint>
#include <string>

namespace skein {

/// How distant boxes see the blobs.
enum class FarField {
  harmonic,     ///< four harmonic potentials with the eps^2 doublet: error floor 0.011 (eps / half-width)^4
  stokeslet,    ///< strengths of singular Stokeslets, matched to the field of the blobs
  regularized,  ///< S_eps in every operator; one common eps
};

enum class FmmPrecision { automatic, in_double, in_single };

enum class OnMiss {
  raise_order,  ///< a measured error above the tolerance is reported and mended with the next order
  stop,         ///< ... ends the run
};

/// What a user may ask of the fast multipole method; 0 leaves a choice to the tables.
struct FmmOptions {
  double tolerance = 1e-4;  ///< relative error of velocities, 2-norm
  FarField far_field = FarField::harmonic;
  int order = 0;               ///< p, points per edge of the surfaces, 3 .. 16
  int leaf_size = 0;           ///< nodes per leaf aimed at
  double min_half_width = 0.0;  ///< of a leaf, length; 0: from the floor law
  FmmPrecision precision = FmmPrecision::automatic;
  bool stokes_part_only = false;  ///< stokeslet: feed the far field S_0 + (eps^2 / 4) Laplacian S_0 instead of S_eps
  double singular_cutoff = 0.0;   ///< of the surface operators, relative; 0: from the order
  int check_every = 0;            ///< evaluations between checks against direct sums; 0: never
  int n_checked_targets = 64;
  OnMiss on_miss = OnMiss::raise_order;
};

/// What an evaluation uses.
struct FmmPlan {
  int order = 6;
  double singular_cutoff = 0.0;
  int leaf_size = 64;
  double min_half_width = 0.0;
  bool near_in_single = false, far_in_single = false;
};

/// The cheapest plan that meets the tolerance, from measured tables (perf/bench_fmm).
/// @param max_blob  the largest regularization length among the sources, length
/// @throws Error(scene_error) where none does.
FmmPlan choose_fmm_plan(const FmmOptions& options, double max_blob);

/// Largest error that blobs cause between well-separated boxes of the harmonic far field: 0.011 (eps / half-width)^4.
double harmonic_floor(double blob, double half_width);

}  // namespace skein
