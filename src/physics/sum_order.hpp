#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/fmm/fmm_plan.hpp>
#include <skein/ranks/communicator.hpp>

#include <cstdint>
#include <type_traits>

namespace skein {

/// What rank 0 wants of the others, sent as bytes; arrays follow where the kind has some.
struct SumOrder {
  enum class Kind { dismiss, tell_work, add_direct, take_nodes, compute_fmm };
  Kind kind = Kind::dismiss;
  int exit_code = 0;  ///< dismiss

  int n_sources = 0, n_targets = 0;  ///< add_direct, take_nodes
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
  Vectors position, force, target;
  Scalars blob;

  Sources sources() const { return {position, force, blob}; }
};

/// Rank 0's side: completes the order, and sends it with the arrays.
void send_nodes(Communicator& ranks, SumOrder& order, const Sources& sources, const ConstVectors& target);

/// The others' side. @param nodes  of an order before: their memory is used again
void receive_nodes(Communicator& ranks, const SumOrder& order, OrderedNodes& nodes);

}  // namespace skein
