#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/fmm/fmm_plan.hpp>
#include <skein/ranks/communicator.hpp>

#include <cstdint>
#include <type_traits>

namespace skein {

/// What rank 0 wants of the others, sent as bytes; arrays follow where the kind has some.
struct SumOrder {
  enum class Kind {
    dismiss,
    tell_work,
    know_scene,
    compute_forces,
    compute_force_changes,
    add_direct,
    take_nodes,
    compute_fmm
  };
  Kind kind = Kind::dismiss;
  int exit_code = 0;  ///< dismiss

  int scene = 0;            ///< know_scene, compute_forces, compute_force_changes: which of the run's
  std::size_t n_bytes = 0;  ///< know_scene: of its text
  double time = 0.0;        ///< compute_forces, compute_force_changes

  int n_sources = 0, n_targets = 0;  ///< add_direct, take_nodes, and those that compute forces
  bool are_held = false;             ///< positions and forces of the sources are those of the order before
  bool are_same_nodes = false;       ///< targets are the sources' own array
  bool has_one_blob = false;         ///< else they follow
  double blob = 0.0;

  double viscosity = 0.0;
  Precision precision = Precision::in_double;  ///< add_direct
  bool by_teams = false;

  int fmm_sum = 0;           ///< take_nodes, compute_fmm: which of the run's
  std::int64_t n_steps = 0;  ///< that have begun
  bool is_in_step = false;
  FmmOptions options;  ///< compute_fmm
  FmmPlan plan;
};
static_assert(std::is_trivially_copyable_v<SumOrder>);

/// The arrays of an order: rank 0 has them, the others make room for them.
struct OrderedNodes {
  Vectors position, force, target, displacement;
  Scalars blob;

  Sources sources() const { return {position, force, blob}; }
};

/// What the others have since they computed forces, by where rank 0 has it.
struct HeldNodes {
  const double *position = nullptr, *force = nullptr;
  int n = 0;

  bool are(const Sources& sources) const {
    return sources.are_shared && n > 0 && sources.position.data() == position && sources.force.data() == force &&
           sources.position.extent_int(0) == n;
  }
};

/// Rank 0's side: completes the order, and sends it with the arrays that the others do not hold.
void send_nodes(Communicator& ranks, SumOrder& order, const Sources& sources, const ConstVectors& target,
                HeldNodes& held);
void send_vectors(Communicator& ranks, const ConstVectors& vectors);

/// The others' side. @param nodes  of an order before: their memory is used again
void receive_nodes(Communicator& ranks, const SumOrder& order, OrderedNodes& nodes);
void receive_vectors(Communicator& ranks, int n, Vectors& vectors);

}  // namespace skein
