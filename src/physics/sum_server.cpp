#include "sum_server.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/sum_team.hpp>
#include <skein/ranks/rank_error.hpp>
#include <skein/scene/scene_file.hpp>

#include "direct_share.hpp"
#include "force_share.hpp"
#include "node_parts.hpp"

#include <new>
#include <string>
#include <unordered_map>
#include <utility>

namespace skein {

std::vector<double> gather_work(Communicator& ranks) {
  const double own = ranks.work_seconds();
  std::vector<double> all(static_cast<std::size_t>(ranks.size()));
  const std::vector<std::size_t> one_each(all.size(), 1);
  ranks.gather(&own, RankParts::behind_each_other(one_each), all.data());
  return all;
}

namespace {

/// A fast multipole sum on a rank that serves, and the step that it has been told of.
struct ServedFmmSum {
  std::unique_ptr<FmmSum> sum;
  std::int64_t n_steps = 0;
};

/// A scene on a rank that serves, and its parts of arrays on the scene's nodes.
struct ServedScene {
  ForceShare share;
  NodeParts parts;
};

/// The loop of the other ranks.
class SumServer {
 public:
  SumServer(Communicator& ranks, const std::function<void(const Vectors& force)>& look) : ranks_(ranks), look_(look) {}

  /// @returns false once dismissed
  bool serve_next() {
    ranks_.broadcast(&order_, sizeof order_);
    for (std::size_t w = 0; w < order_.n_works; ++w) work(order_.works[w]);
    for (const auto& [gathers, rows] :
         {std::pair{order_.gathers_positions, nodes_.position}, std::pair{order_.gathers_forces, nodes_.force}})
      if (gathers) gather_rows_to_all(ranks_, scenes_.at(order_.gathered_scene).share.nodes, rows);
    switch (order_.kind) {
      case SumOrder::Kind::dismiss:
        return false;
      case SumOrder::Kind::tell_work:
        gather_work(ranks_);
        return true;
      case SumOrder::Kind::know_scene:
        know_scene();
        return true;
      case SumOrder::Kind::compute_forces:
      case SumOrder::Kind::compute_force_changes:
        compute_forces();
        return true;
      case SumOrder::Kind::add_direct:
        begin_sum(RankWork::direct_sum);
        add_direct();
        return true;
      case SumOrder::Kind::take_nodes:
        begin_sum(RankWork::taking_nodes);
        take_nodes(sums_[order_.fmm_sum]);
        return true;
      case SumOrder::Kind::compute_fmm:
        ranks_.begin_work(RankWork::fmm_sum);
        compute_fmm(*sums_.at(order_.fmm_sum).sum);
        ranks_.end_work();
        return true;
      case SumOrder::Kind::sample_fmm:
        gather_sample(ranks_, scenes_.at(order_.scene).parts.owners(), *sums_.at(order_.fmm_sum).sum,
                      EvenSample(order_.n_sampled, order_.n_chosen));
        return true;
      case SumOrder::Kind::work_on_parts:
        return true;
      case SumOrder::Kind::evaluate:
      case SumOrder::Kind::evaluate_changes:
        evaluate();
        return true;
      case SumOrder::Kind::dot_product_of_parts:
      case SumOrder::Kind::gather_parts:
      case SumOrder::Kind::scatter_parts:
        move_parts(scenes_.at(order_.scene).parts);
        return true;
    }
    throw Error(ExitCode::internal, "an order of no known kind");
  }
  int exit_code() const { return order_.exit_code; }

 private:
  void begin_sum(const RankWork kind) {
    receive_nodes(ranks_, order_, nodes_);
    ranks_.begin_work(kind);
    if (look_) look_(nodes_.force);
  }
  void know_scene() {
    std::string text(order_.n_bytes, ' ');
    ranks_.broadcast(text.data(), text.size());
    scenes_.erase(order_.scene);
    ForceShare share(read_scene_text(text, "the scene of rank 0", {}, {}).config, ranks_.size());
    const NodeParts parts(share.nodes, ranks_.rank());
    scenes_.emplace(order_.scene, ServedScene{std::move(share), parts});
  }
  void work(const PartWork& work) {
    NodeParts& parts = scenes_.at(work.scene).parts;
    if (work.kind != PartWork::Kind::add_fmm_sum) return parts.work(work);
    const Vectors velocity = parts.rows(work.result);
    if (velocity.extent(0) > 0) sums_.at(work.source[0]).sum->add_to(velocity);
  }
  void move_parts(const NodeParts& parts) {
    const Vectors& part = parts[order_.array];
    if (order_.kind == SumOrder::Kind::dot_product_of_parts)
      add_up_products(ranks_, parts.owners(), part, parts[order_.other_array]);
    else if (order_.kind == SumOrder::Kind::gather_parts)
      gather_parts(ranks_, parts.owners(), part, {});
    else
      scatter_parts(ranks_, parts.owners(), {}, part);
  }
  static void make_room(Vectors& all, const std::size_t n_nodes) {
    if (all.extent(0) != n_nodes) all = Vectors("skein::SumServer::all", n_nodes);
  }
  /// @returns means over sections, where forces see those and no rank has all nodes; else none
  Vectors gather_where_needed(const ForceShare& share, const Vectors& part, const Vectors& whole) {
    return gather_for_forces(ranks_, share.nodes, share.needed, *share.sections, order_.are_local, part, whole);
  }
  void evaluate() {
    const auto& [share, parts] = scenes_.at(order_.scene);
    make_room(nodes_.position, share.nodes.total());
    make_room(nodes_.force, share.nodes.total());
    ranks_.begin_work(RankWork::forces);
    const bool are_changes = order_.kind == SumOrder::Kind::evaluate_changes;
    if (!order_.are_held) seen_.centroid = gather_where_needed(share, parts[order_.array], nodes_.position);
    const Vectors velocity = parts.rows(order_.velocity);
    if (are_changes) {
      make_room(nodes_.displacement, share.nodes.total());
      seen_.mean_displacement = gather_where_needed(share, parts[order_.displacement], nodes_.displacement);
      Kokkos::deep_copy(ExecSpace(), velocity, 0.0);
    } else if (velocity.extent(0) > 0) {
      share.flow->compute_velocity(order_.time, parts.rows(order_.array), velocity);
    }
    seen_.position = nodes_.position;
    seen_.displacement = are_changes ? ConstVectors(nodes_.displacement) : ConstVectors();
    ForceShare::compute_own(ranks_, share.nodes, share.forces, order_.time, seen_, nodes_.force);
  }
  void add_direct() {
    const NodeParts* const parts = order_.is_delivered ? &scenes_.at(order_.scene).parts : nullptr;
    direct_.add_velocity(ranks_, nodes_.sources(), nodes_.target,
                         parts == nullptr ? Vectors() : parts->rows(order_.velocity), order_.viscosity,
                         order_.precision, order_.by_teams, parts == nullptr ? nullptr : &parts->owners());
  }
  void compute_fmm(FmmSum& sum) {
    sum.owners = order_.is_delivered ? scenes_.at(order_.scene).parts.owners() : RankParts();
    sum.compute(order_.options, order_.plan, order_.viscosity);
  }
  void compute_forces() {
    const ForceShare& share = scenes_.at(order_.scene).share;
    const bool are_changes = order_.kind == SumOrder::Kind::compute_force_changes;
    receive_vectors(ranks_, order_.n_sources, nodes_.position);
    if (are_changes) receive_vectors(ranks_, order_.n_sources, nodes_.displacement);
    make_room(nodes_.force, static_cast<std::size_t>(order_.n_sources));
    ForceShare::compute(ranks_, share.nodes, share.forces, order_.time, nodes_.position,
                        are_changes ? ConstVectors(nodes_.displacement) : ConstVectors(), nodes_.force);
  }
  void take_nodes(ServedFmmSum& served) {
    if (order_.is_new_sum) served = {make_fmm_sum(order_.path, &ranks_)};
    if (served.n_steps != order_.n_steps) served.sum->begin_step();
    served.n_steps = order_.n_steps;
    if (!order_.is_in_step) served.sum->end_step();
    if (order_.is_divided) {
      const RankParts parts = order_.is_delivered ? scenes_.at(order_.scene).parts.owners()
                                                  : RankParts::evenly(nodes_.position.extent(0), ranks_.size());
      const auto rank = static_cast<std::size_t>(ranks_.rank());
      served.sum->take_part(rows_of(nodes_.sources(), parts.first[rank], parts.count[rank]), parts);
    } else {
      served.sum->take(nodes_.sources(), nodes_.target);
    }
    ranks_.end_work();
  }

  Communicator& ranks_;
  const std::function<void(const Vectors& force)>& look_;
  SumOrder order_;
  OrderedNodes nodes_;
  SeenNodes seen_;  ///< in the last evaluation, for forces
  DirectShare direct_;
  std::unordered_map<int, ServedFmmSum> sums_;
  std::unordered_map<int, ServedScene> scenes_;
};

}  // namespace

int serve_sums(Communicator& ranks, const std::function<void(const Vectors& force)>& look) {
  SumServer server(ranks, look);
  try {
    while (server.serve_next()) continue;
  } catch (const RankError&) {
    throw;
  } catch (const Error& error) {
    ranks.fail(static_cast<int>(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    ranks.fail(71, "there is not enough memory");
  } catch (const std::exception& error) {
    ranks.fail(static_cast<int>(ExitCode::internal), error.what());
  }
  return server.exit_code();
}

}  // namespace skein
