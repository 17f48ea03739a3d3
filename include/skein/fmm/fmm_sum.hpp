#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/arrays/types.hpp>
#include <skein/fmm/even_sample.hpp>
#include <skein/fmm/fmm_cost.hpp>
#include <skein/ranks/communicator.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace skein {

/// What the last evaluation met: for the cost card, the benchmarks and the tests.
struct FmmStatistics {
  FmmPlan plan;
  std::int64_t n_trees = 0;  ///< made so far
  int n_boxes = 0;
  int n_levels = 0;
  int n_leaves = 0;                  ///< with targets
  double smallest_half_width = 0.0;  ///< of a leaf, length
  FmmWork work;
  bool used_direct_sum = false;  ///< the lists showed that it costs less, or the tolerance is out of reach
  double memory_bytes = 0.0;     ///< of the tree, the nodes' copies, coefficients and operators
  /// Wall time, s: operators first met, tree, copies of the nodes, passes over the boxes, leaves. See times_parts.
  double operators_seconds = 0.0, tree_seconds = 0.0, sort_seconds = 0.0, far_seconds = 0.0, leaf_seconds = 0.0;
};

/// One way of an evaluation through the machine. FmmMobility asks it for a sum, and adds, checks and reports.
class FmmSum {
 public:
  virtual ~FmmSum() = default;

  /// Takes the arrays of the next sum; false where a position is not finite.
  virtual bool take(const Sources& sources, const ConstVectors& target) = 0;
  /// The same for nodes of which each rank has its own, and needs no others: sources that are the targets. To be called
  /// by all ranks. @param own  rows parts.first[rank] .. of all nodes  @param parts  of all nodes, one behind the other
  /// @throws Error(internal) where no ranks share the sum
  virtual bool take_part(const Sources& own, const RankParts& parts);
  virtual double largest_blob() const = 0;
  /// From here to the end of the step nodes move little from sum to sum, and a tree may serve several.
  virtual void begin_step() = 0;
  virtual void end_step() noexcept = 0;
  /// The sum after a plan; false where a direct sum is cheaper and may be used.
  virtual bool compute(const FmmOptions& options, const FmmPlan& plan, double viscosity) = 0;
  /// velocity += the sum: on rank 0 all of it, or on all ranks the rows of `owners`
  virtual void add_to(const Vectors& velocity) const = 0;
  /// The sum at some targets.
  virtual std::vector<Vec3> sample(const EvenSample& sample) const = 0;

  FmmStatistics statistics;
  /// The parts of a sum wait for each other, so that the seconds in the statistics are theirs. On devices that takes
  /// time.
  bool times_parts = on_host<ExecSpace>;

  /// With ranks: who has the velocities of which targets in the end, consecutive ones each; `add_to` then takes this
  /// rank's. Empty, as at first: rank 0 has all. To be set alike on all ranks before `compute`.
  RankParts owners;
};

/// @param path  automatic: on the host where kernels run there, else on the device
/// @param ranks  processes that share the sum, to the same bits: all of them take and compute it with the same
/// arguments, on hosts or each on a device of its own, and rank 0 has it. Null: this one alone
std::unique_ptr<FmmSum> make_fmm_sum(KernelPath path, Communicator* ranks = nullptr);

}  // namespace skein
