#pragma once

#include <skein/core/sign_matrix.hpp>

#include <vector>

namespace skein {

/// A run of orbits of nodes under a group of sign matrices whose first nodes are kept in place by the same matrices: in
/// general only by the identity; on a plane of symmetry, an axis or at the origin by more.
struct OrbitClass {
  int first = 0, count = 0;            ///< of the list of all orbits
  std::vector<SignMatrix> stabilizer;  ///< a subgroup; the identity comes first
};

/// The matrices that suffice, one for each image of a node of class b, seen from nodes of class a: what moves neither
/// of two nodes otherwise than a matrix before it makes no new pair. The identity comes first.
std::vector<SignMatrix> list_distinct_images(const std::vector<SignMatrix>& group, const OrbitClass& a,
                                             const OrbitClass& b);

/// Pairs of a target and a source that a sum over the first nodes of all orbits and the distinct images weighs. Without
/// symmetry this is the square of the number of nodes.
double count_image_pairs(const std::vector<SignMatrix>& group, const std::vector<OrbitClass>& classes);

}  // namespace skein
