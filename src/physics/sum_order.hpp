#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/fmm/fmm_plan.hpp>
#include <skein/ranks/communicator.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <vector>

namespace skein {

/// What each rank does with its parts of some arrays, of which rank 0 says the numbers.
struct PartWork {
  enum class Kind { make, drop, copy, set_to_zero, combine, add_fmm_sum };
  static constexpr int most_terms = 5;
  Kind kind = Kind::make;
  int scene = 0;  ///< whose nodes they are on
  int result = 0;
  int n_terms = 0;              ///< combine; copy has one
  int source[most_terms] = {};  ///< arrays; of add_fmm_sum the sum
  double factor[most_terms] = {};
};

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
    compute_fmm,
    sample_fmm,
    work_on_parts,
    evaluate,
    evaluate_changes,
    dot_product_of_parts,
    gather_parts,
    scatter_parts
  };
  Kind kind = Kind::dismiss;
  int exit_code = 0;  ///< dismiss

  /// know_scene, compute_forces, compute_force_changes, and whose arrays are meant, or whose ranks own the targets:
  /// which of the run's
  int scene = 0;
  std::size_t n_bytes = 0;  ///< know_scene: of its text
  double time = 0.0;        ///< of all that compute forces or changes of them

  int n_sources = 0, n_targets = 0;  ///< add_direct, take_nodes, and those that compute forces
  bool are_held = false;             ///< positions and forces of the sources are those of the order before;
                                     ///< evaluate_changes: positions those of the last evaluation
  bool are_same_nodes = false;       ///< targets are the sources' own array
  bool has_one_blob = false;         ///< else they follow
  double blob = 0.0;

  double viscosity = 0.0;
  Precision precision = Precision::in_double;  ///< add_direct
  bool by_teams = false;

  bool is_divided = false;                  ///< take_nodes: each rank takes some, of a tree of which it has a part
  int fmm_sum = 0;                          ///< take_nodes, compute_fmm: which of the run's
  KernelPath path = KernelPath::automatic;  ///< that it is made for
  bool is_new_sum = true;                   ///< take_nodes: what has had the number before is gone, its tree, too
  std::int64_t n_steps = 0;                 ///< that have begun
  bool is_in_step = false;
  FmmOptions options;  ///< compute_fmm
  FmmPlan plan;

  /// First of all: rows of those of the last evaluation, from their owners to all ranks
  bool gathers_positions = false, gathers_forces = false;
  int gathered_scene = 0;     ///< of which scene that was
  bool are_local = false;     ///< evaluate, evaluate_changes: ranks get the rows that they need for their own forces
  bool is_delivered = false;  ///< add_direct, take_nodes, compute_fmm: to the ranks that own the targets, not to rank 0
  int array = 0;         ///< evaluate, evaluate_changes: positions; dot_product_of_parts, gather_parts, scatter_parts
  int other_array = 0;   ///< dot_product_of_parts
  int displacement = 0;  ///< evaluate_changes: an array
  int velocity = 0;      ///< evaluate, evaluate_changes, and add_direct that is delivered: an array
  int n_sampled = 0, n_chosen = 0;  ///< sample_fmm

  /// Before the order itself is obeyed.
  static constexpr int most_works = 8;
  std::size_t n_works = 0;
  PartWork works[most_works];
  void take_works(const PartWork* first, const std::size_t n) {
    n_works = n;
    std::copy_n(first, n, works);
  }
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

/// An array on nodes of which each rank has the rows of its own nodes, and maybe some others.
struct OwnRows {
  const RankParts* owners = nullptr;  ///< null: there is none
  int scene = 0;
  Vectors rows;  ///< [n_nodes, 3], of rank 0

  bool are(const ConstVectors& vectors) const { return owners != nullptr && rows.data() == vectors.data(); }
};

/// A sum in work whose targets are nodes that ranks own: each gets the velocities of its own.
struct Delivery {
  const RankParts& owners;
  int scene = 0;
  int velocity = 0;                ///< the array that it is added to
  Vectors room;                    ///< [n_nodes, 3], what the mobility is given for it: rank 0's own nodes are first
  std::function<void()> complete;  ///< makes the others' rows there what they were if rank 0 had all
  bool is_done = false;

  Vectors own_rows() const;
};

/// Some of the sources, which are their own targets.
Sources rows_of(const Sources& sources, std::size_t first, std::size_t n);

/// Rank 0's side of what the others are told.
struct TeamLink {
  explicit TeamLink(Communicator& communicator) : ranks(communicator) {}

  Communicator& ranks;
  HeldNodes held;
  const double* held_position = nullptr;  ///< the positions that the others have, whole or those of own_positions,
                                          ///< since they computed forces
  OwnRows own_positions, own_forces;
  bool has_divided = false;      ///< in the last sum each rank needed the positions of its own nodes only
  Delivery* delivery = nullptr;  ///< null: rank 0 has all velocities in the end
  bool has_parts = false;        ///< ranks have been told to make parts of arrays

  /// To be done before the next order. Nothing is sent.
  void note(const PartWork& work) { works_.push_back(work); }
  void send(SumOrder& order);
  /// The others have other positions now.
  void forget_positions() {
    held_position = nullptr;
    own_positions = {};
  }
  /// For who looks at sources that he has been given: what is other nodes' comes from their owners. Of other arrays
  /// nothing.
  void complete(const Sources& sources);
  /// The same with an order, which is sent.
  void send_completing(SumOrder& order, const Sources& sources);

 private:
  void post(SumOrder& order);

  std::vector<PartWork> works_;
};

/// Rank 0's side: completes the order, and sends it with the arrays that the others do not hold; of a sum that is
/// divided (order.is_divided) each rank needs the forces on its own nodes only.
void send_nodes(TeamLink& link, SumOrder& order, const Sources& sources, const ConstVectors& target);
void send_vectors(Communicator& ranks, const ConstVectors& vectors);

/// The others' side. @param nodes  of an order before: their memory is used again
void receive_nodes(Communicator& ranks, const SumOrder& order, OrderedNodes& nodes);
void receive_vectors(Communicator& ranks, int n, Vectors& vectors);

}  // namespace skein
