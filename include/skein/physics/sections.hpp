#pragma once

#include <skein/arrays/types.hpp>
#include <skein/fibers/fiber.hpp>

#include <memory>
#include <vector>

namespace skein {

struct FiberSections;
template <class Space>
struct SectionBoxes;
template <class Space>
struct TubeSurfaces;

/// How far fibers stick in each other.
struct Penetration {
  int nodes = 0;       ///< inside the surface of another fiber, or of a distant part of their own
  double depth = 0.0;  ///< of the deepest: its distance to that surface, length
};

/// What a step's record says of sections.
struct SectionRecord {
  std::vector<Vec3> centreline;  ///< as compute_centreline gives it
  double smallest_gap = 0.0;     ///< as compute_smallest_gap
  Penetration penetration;       ///< as compute_penetration
};

/// Blocks of sections that follow each other.
struct SectionBlocks {
  int first = 0, count = 0;
};

/// The sections of all fibers on the device: what is asked of all of them takes one launch or a few, however many
/// fibers there are. One call at a time: the object holds scratch.
class Sections {
 public:
  explicit Sections(const std::vector<Fiber>& fibers);
  ~Sections();
  Sections(Sections&&) noexcept;
  Sections& operator=(Sections&&) noexcept;

  int n_nodes() const { return n_nodes_; }
  int n_sections() const { return n_sections_; }

  /// The first node that is not finite, or farther from its section's centroid than max_ratio radii of its fiber; -1
  /// where there is none. One launch and one wait.
  /// @param position  [n_nodes, 3], length, as in all calls below
  int find_faulty_node(const ConstVectors& position, double max_ratio) const;

  /// The same in two parts, between which something else is waited for: launches the search,
  void seek_faulty_node(const ConstVectors& position, double max_ratio) const;
  /// and says what it found, after a wait for the device.
  int found_faulty_node() const;

  /// Overwrites mean, [n_sections, 3], with the mean over each section's nodes of a vector on nodes, [n_nodes, 3].
  void compute_means(const ConstVectors& vector, const Vectors& mean) const;
  /// The same for the sections of the nodes [first, first + n), and maybe of some others.
  void compute_means_on(int first, int n, const ConstVectors& vector, const Vectors& mean) const;

  /// Centroids of all sections. @returns [n_sections], length
  std::vector<Vec3> compute_centreline(const ConstVectors& position) const;

  /// The smallest distance between the surfaces of two fibers, or of distant sections of one (see
  /// Fiber::distant_sections), taken as spheres about the sections' centroids; negative where they overlap, infinite
  /// where there is no such pair. Length
  double compute_smallest_gap(const ConstVectors& position) const;

  /// Nodes inside of surfaces, which are those of the prisms between neighbouring rings of nodes, however they are
  /// deformed, closed at both ends; distant parts of a fiber are those of Fiber::distant_sections. Exact: unlike the
  /// gap, it does not take sections for spheres. A chain has no surface: its nodes may be inside of others, none are
  /// inside of it.
  Penetration compute_penetration(const ConstVectors& position) const;

  /// Centreline, gap and penetration, for which sections are located once: in five launches and one wait, and one more
  /// of each where nodes are inside of surfaces.
  SectionRecord look(const ConstVectors& position) const;

  /// The same in two parts: launches the search,
  void seek(const ConstVectors& position) const;
  /// and says what it found, after a wait for the device.
  SectionRecord found() const;

  /// Centroids, and boxes about blocks of sections and about fibers, of nodes at `position`: for kernels.
  const SectionBoxes<ExecSpace>& locate(const ConstVectors& position) const;
  /// The same from the centroids, [n_sections, 3].
  const SectionBoxes<ExecSpace>& locate_at(const ConstVectors& centroid) const;
  /// The blocks of sections that the nodes [first, first + n) are in, for kernels.
  SectionBlocks blocks_of(int first, int n) const;

 private:
  void seek_penetration(const ConstVectors& position) const;
  Penetration found_penetration() const;

  int n_nodes_, n_sections_;
  std::unique_ptr<std::vector<FiberSections>> fibers_;
  std::unique_ptr<SectionBoxes<ExecSpace>> boxes_;
  std::unique_ptr<TubeSurfaces<ExecSpace>> surfaces_;
  Scalars depth_;  ///< [n_nodes], of nodes in surfaces, length
  FoundNumber faulty_node_, n_inside_;
  FoundReal gap_;
  VectorView<SharedHostMemory> centreline_;  ///< [n_sections, 3], length
};

}  // namespace skein
