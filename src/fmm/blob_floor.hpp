#pragma once

#include <skein/fmm/fmm_plan.hpp>

namespace skein {

/// Error that blobs cause between the nearest well-separated boxes, over the velocities there.
/// @param degree  of the polynomials that carry the term of eps^4; 0: it is left out, and must be but for the harmonic
///                field
/// @param ratio   eps / half-width
double blob_floor(const FmmOptions& options, int degree, double ratio);

/// The largest eps / half-width at which that floor is `allowed`.
double largest_blob_ratio(const FmmOptions& options, int degree, double allowed);

/// The lowest degree beyond which the floor would gain little: leaves would be less than 1.15 times smaller. 0 where
/// the far field or the options leave the term out.
int choose_tail_degree(const FmmOptions& options, double allowed);

/// True for what the options may ask for: see FmmOptions::tail_degree.
bool is_tail_degree(int degree);

}  // namespace skein
