#pragma once

namespace skein {

/// How distant boxes of the fast multipole method see the blobs.
enum class FarField {
  harmonic,     ///< four harmonic potentials with the eps^2 doublet: error floor 0.011 (eps / half-width)^4
  stokeslet,    ///< strengths of singular Stokeslets, matched to the field of the blobs: floor 0.1 (eps / half-width)^4
  regularized,  ///< S_eps in every operator, one common eps: floor 0.05 (eps / half-width)^4
};

/// What follows when a check of the fast multipole method measures a larger error than the tolerance.
enum class OnMiss {
  raise_order,  ///< the error is reported and mended with the next order
  stop,         ///< the run ends
};

}  // namespace skein
