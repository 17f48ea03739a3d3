#pragma once

#include <skein/physics/background_flow.hpp>
#include <skein/physics/sections.hpp>
#include <skein/physics/sum_team.hpp>
#include <skein/scene/scene_config.hpp>

#include "force_table.hpp"
#include "needed_rows.hpp"
#include "sum_order.hpp"

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace skein {

/// Of a scene that ranks know: its forces, and for whose nodes each rank computes them, which are whole sections.
struct ForceShare {
  ForceList forces;
  RankParts nodes;
  NeededRows needed;
  std::unique_ptr<BackgroundFlow> flow;
  std::unique_ptr<Sections> sections;

  explicit ForceShare(const SceneConfig& asked, int n_ranks);

  /// To be called by all ranks. Overwrites `force` with the sum of all forces, or of their changes, on all nodes; its
  /// order does not depend on how many ranks there are.
  /// @param displacement  empty: forces, not changes of them
  static void compute(Communicator& ranks, const RankParts& nodes, const ForceList& forces, double time,
                      const ConstVectors& position, const ConstVectors& displacement, const Vectors& force);
  /// The same on this rank's nodes; others' rows stay as they are.
  static void compute_own(Communicator& ranks, const RankParts& nodes, const ForceList& forces, double time,
                          const SeenNodes& seen, const Vectors& force);
};

/// By what the forces promise of their reach.
NeededRows find_needed_rows(const std::vector<Fiber>& fibers, const ForceList& forces, const RankParts& owners);

/// Nodes of consecutive sections for each rank, with about as many springs.
RankParts share_nodes(const std::vector<Fiber>& fibers, int n_ranks);

/// Rank 0's side of a scene's forces that all ranks compute. The team must outlive it.
class SharedForces {
 public:
  /// Tells the others of the scene. @param forces  that make_forces has made of it
  /// @throws Error(scene_error) where the scene's text could not be read by them
  /// @param link, numbers  of the team, and scenes that there are
  SharedForces(TeamLink& link, std::set<int>& numbers, const SceneConfig& scene, const std::vector<Fiber>& fibers,
               const ForceList& forces);
  ~SharedForces();
  SharedForces(const SharedForces&) = delete;
  SharedForces& operator=(const SharedForces&) = delete;

  /// See ForceShare::compute. @returns false, with nothing done, where these are not the forces that the others know
  bool compute(const ForceList& forces, double time, const ConstVectors& position, const ConstVectors& displacement,
               const Vectors& force);

  bool know(const ForceList& forces) const;
  int scene() const { return order_.scene; }
  const RankParts& nodes() const { return nodes_; }
  const NeededRows& needed() const { return needed_; }

 private:
  TeamLink& link_;
  std::set<int>& numbers_;
  std::vector<const Force*> known_;
  RankParts nodes_;
  NeededRows needed_;
  SumOrder order_;
};

}  // namespace skein
