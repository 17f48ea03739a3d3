#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/physics/force.hpp>
#include <skein/physics/sections.hpp>

#include <memory>
#include <vector>

namespace skein {

/// A soft repulsion of finite range between sections of different fibers and distant sections of one (see
/// Fiber::distant_sections). With the gap g = distance of their centroids - radii, two sections that stand for h and h'
/// of their fibers have the energy
///
///   U = strength h h' (1 - g/range)^3 / 3 for g < range, else 0
///
/// so that sums over sections converge to integrals over arclength. Forces are central and spread equally over a
/// section's nodes: they turn and move nothing as a whole. They do not depend on the number of threads. At contact two
/// parallel fibers of radius R push with 32/15 strength sqrt(R / range) per length, if range is far below R, and two
/// that cross at right angles with 4 pi/3 strength R.
///
/// The time is in proportion to sections where those near each other are few; fibers find each other by their boxes.
class SectionRepulsion final : public Force {
 public:
  /// @param strength  force / length, >= 0
  /// @param range     length, > 0
  SectionRepulsion(const std::vector<Fiber>& fibers, double strength, double range);

  double strength() const { return strength_; }
  double range() const { return range_; }

  ForcePromises promises() const override;
  void add_forces(double time, const ConstVectors& position, const Vectors& force) const override;
  void add_force_changes(double time, const ConstVectors& position, const ConstVectors& displacement,
                         const Vectors& change) const override;
  void add_forces_on(int first, int n, double time, const SeenNodes& nodes, const Vectors& force) const override;
  void add_force_changes_on(int first, int n, double time, const SeenNodes& nodes,
                            const Vectors& change) const override;

  void seek_measures(double time, const ConstVectors& position) const override;
  /// Half of a pair's energy goes to each fiber.
  void add_found_energies(std::vector<double>& energy) const override;

  /// Sum over pairs of d f / 2, d from the other section's centroid and f the force on the fiber's: summed over all
  /// fibers the first moment of these forces.
  void add_moments(const std::vector<Fiber>& fibers, double time, const ConstVectors& position,
                   std::vector<SymmetricTensor>& moment) const override;
  std::string describe() const override;

 private:
  const SectionBoxes<ExecSpace>& locate(const SeenNodes& nodes) const;

  double strength_, range_;
  std::vector<int> n_sections_;  ///< [n_fibers]
  Sections sections_;
  Vectors displacement_;  ///< [n_sections, 3]
  FoundReals energy_;     ///< [n_sections]
};

}  // namespace skein
