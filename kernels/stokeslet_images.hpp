#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/orbit_class.hpp>
#include <skein/core/precision.hpp>

#include "kernels/index_range.hpp"
#include "kernels/ordered_matches.hpp"

#include <vector>

namespace skein {

/// Which tiles of nodes meet in a sum over the first nodes of orbits and their images, each pair of a node and an image
/// once. Arrays hold a copy of the first nodes for each element of the group, the first ones themselves in front: the
/// image of orbit o under element e has the index e n_orbits + o.
///
/// With d = x_i - S x_j the image S f_j moves node i by G(d) S f_j, and f_i moves node j by S G(d) f_i, which is what
/// the image of node j under S receives, mapped back. So both are halves of one exchange between a tile of first nodes
/// and a tile of images, with the loops of all other sums. Nodes that some elements keep in place make classes of their
/// own, whose tiles meet fewer images with larger weights.
struct ImageMatches {
  struct Tile {
    IndexRange orbits;
    int orbit_class = 0;
  };
  int n_orbits = 0;
  int n_classes = 0;
  std::vector<Tile> tiles;     ///< of a copy
  std::vector<Match> matches;  ///< `one` is a tile of first nodes; tile t of copy e has the number e tiles.size() + t
  std::vector<double> weight;  ///< [n_classes, n_classes]: matrices that make the same pairs of two nodes

  IndexRange run_of(int tile) const;
  double weight_of(const Match& match) const;
};

ImageMatches make_image_matches(const std::vector<SignMatrix>& group, const std::vector<OrbitClass>& classes);

/// velocity += the regularized Stokeslets of first nodes and images, on the host. The velocity of an orbit is the sum
/// of its copies' velocities, each mapped back.
/// @param position, force, velocity  [copies, 3], see ImageMatches; a force is that of a node and of its images, over
///                                   the number of elements that keep the node in place
/// @param blob                       [copies], all equal (not checked)
void add_image_stokeslet_velocity(const HostSpace& space, const ImageMatches& matches,
                                  const ConstVectorView<HostSpace>& position, const ConstVectorView<HostSpace>& force,
                                  const ConstScalarView<HostSpace>& blob, const VectorView<HostSpace>& velocity,
                                  double viscosity, Precision precision);

}  // namespace skein
