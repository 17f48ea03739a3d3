#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_boxes.hpp"

namespace skein {

/// Energy of two sections, each standing for its fiber's spacing h, with the gap g = distance of centroids - radii:
///
///   U = strength h h' (1 - g/range)^3 / 3 for g < range, else 0
///
/// It has two continuous derivatives, grows on where sections overlap, and converges to a double integral over
/// arclength as sections come closer. Sections of one fiber that are not distant have none.
struct RepulsionLaw {
  double strength = 0.0;  ///< force / length
  double range = 0.0;     ///< length
};

// All of them see the sections where locate_sections left them. Each section gathers over its near ones in a fixed
// order; but for the rounding of its sum, what it has from a pair is the opposite of what the other has.

/// Adds the repulsion on the sections of some blocks to force, [n_nodes, 3]: a section's force in equal parts to its
/// nodes. Two sections with coincident centroids do not push each other. Other blocks of the fibers may get theirs,
/// too.
template <class Space>
void add_section_repulsion(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                           IndexRange blocks, const VectorView<Space>& force);

/// Adds to change, [n_nodes, 3], the first-order change of those forces when centroids move by `displacement`,
/// [n_sections, 3].
template <class Space>
void add_section_repulsion_change(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                                  IndexRange blocks, const ConstVectorView<Space>& displacement,
                                  const VectorView<Space>& change);

/// Overwrites energy, [n_sections], with half of the energy of each pair that a section is in.
template <class Space>
void compute_repulsion_energy(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                              const FoundReals& energy);

/// Overwrites the moment of each section with the sum of d f / 2 over its pairs, d from the other centroid and f the
/// force on the section: a symmetric matrix, diagonal (xx, yy, zz) and mixed (yz, xz, xy), each [n_sections, 3].
template <class Space>
void compute_repulsion_moment(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                              const VectorView<Space>& diagonal, const VectorView<Space>& mixed);

}  // namespace skein
