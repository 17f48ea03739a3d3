#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/core/precision.hpp>
#include <skein/fmm/fmm_sum.hpp>
#include <skein/physics/force.hpp>
#include <skein/ranks/communicator.hpp>
#include <skein/scene/scene_config.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace skein {

class BackgroundFlow;
class SharedForces;
class SharedNodes;

/// Ranks that share the sums and forces of one run. Rank 0 holds the run and this object, and asks the others for their
/// parts of a sum when there is one, or to work on their parts of arrays; they take no decision, so that nothing of a
/// run can depend on how many they are. The others call serve_sums.
class SumTeam {
 public:
  /// @param ranks  must outlive the team, which holds arrays
  explicit SumTeam(Communicator& ranks);
  ~SumTeam();
  SumTeam(const SumTeam&) = delete;
  SumTeam& operator=(const SumTeam&) = delete;

  const Communicator& ranks() const;

  /// velocity += the sum over all sources, pair by pair. See DirectMobility.
  void add_direct(const Sources& sources, const ConstVectors& target, const Vectors& velocity, double viscosity,
                  Precision precision, bool by_teams);

  /// A fast multipole sum that ranks share, to be used as that of one process. The team must outlive it.
  std::unique_ptr<FmmSum> make_fmm_sum(KernelPath path);

  /// The forces of a scene, to be computed by all ranks; null where there are no others. @param scene  as make_physics
  /// is given it  @param forces  made of it
  std::shared_ptr<SharedForces> share_forces(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                             const std::vector<std::unique_ptr<Force>>& forces);

  /// The nodes of a scene, each owned by a rank. @param forces  of share_forces; null: nothing is shared
  std::shared_ptr<SharedNodes> share_nodes(const std::shared_ptr<SharedForces>& forces, const BackgroundFlow& flow);

  /// For who looks at a velocity that he has been given to add to: on rank 0 it has only its own nodes' rows, before
  /// this.
  void complete(const Vectors& velocity);

  /// For who looks at sources that he has been given: on rank 0 positions and forces may be those of its own nodes
  /// only, before this.
  void complete(const Sources& sources);

  /// True since an integrator was made whose arrays ranks have parts of.
  bool advances_parts() const;

  /// How the last sum was divided, in words; empty before there was one.
  const std::string& partition() const;

  /// Wall time that each rank has worked on its parts of sums so far, seconds.
  std::vector<double> work_seconds();

 private:
  class SharedFmmSum;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// One line: how even that is. @param seconds  of each rank, as work_seconds has it
std::string describe_balance(const std::vector<double>& seconds);

/// What ranks other than 0 do: their parts of sums, until they are dismissed. @returns the exit code that they are told
/// @throws RankError where rank 0 is lost
/// @param look  for tests: sees, and may change, the forces of each sum before this rank's part of it; empty: nothing
/// does
int serve_sums(Communicator& ranks, const std::function<void(const Vectors& force)>& look = {});

/// Rank 0 lets the others leave serve_sums.
void dismiss_ranks(Communicator& ranks, int exit_code);

}  // namespace skein
