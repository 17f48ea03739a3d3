#pragma once

#include <skein/arrays/types.hpp>
#include <skein/fibers/fiber.hpp>

#include <array>
#include <memory>
#include <vector>

namespace skein {

template <class Space>
struct SectionBoxes;

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
/// One call at a time: the object holds scratch.
class SectionRepulsion {
 public:
  /// @param strength  force / length, >= 0
  /// @param range     length, > 0
  SectionRepulsion(const std::vector<Fiber>& fibers, double strength, double range);
  ~SectionRepulsion();
  SectionRepulsion(SectionRepulsion&&) noexcept;
  SectionRepulsion& operator=(SectionRepulsion&&) noexcept;

  double strength() const { return strength_; }
  double range() const { return range_; }

  /// Adds the repulsion to the force on each node.
  /// @param position, force  [n_nodes, 3], length and force
  void add_forces(const ConstVectors& position, const Vectors& force) const;

  /// Adds the first-order change of these forces when nodes move by `displacement`.
  /// @param position, displacement, change  [n_nodes, 3], length, length and force
  void add_force_changes(const ConstVectors& position, const ConstVectors& displacement, const Vectors& change) const;

  /// Adds its energy, force * length, half of a pair to each fiber. @param energy  [n_fibers]
  void add_energies(const ConstVectors& position, std::vector<double>& energy) const;

  /// Sum over pairs of d f / 2, d from the other section's centroid and f the force on the fiber's: summed over all
  /// fibers the first moment of these forces. Force * length.
  /// @returns [n_fibers], each xx, yy, zz, yz, xz, xy
  std::vector<std::array<double, 6>> compute_moments(const ConstVectors& position) const;

 private:
  void locate(const ConstVectors& position) const;

  double strength_, range_;
  int n_nodes_;
  std::vector<int> n_sections_;  ///< [n_fibers]
  std::unique_ptr<SectionBoxes<ExecSpace>> boxes_;
  Vectors displacement_;  ///< [n_sections, 3]
};

/// What a scene asks for; null where its strength is 0.
std::unique_ptr<SectionRepulsion> make_section_repulsion(const RepulsionConfig& config,
                                                         const std::vector<Fiber>& fibers);

}  // namespace skein
