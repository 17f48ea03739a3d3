#include "sum_server.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/sum_team.hpp>
#include <skein/ranks/rank_error.hpp>
#include <skein/scene/scene_file.hpp>

#include "direct_share.hpp"
#include "force_share.hpp"

#include <map>
#include <new>
#include <string>

namespace skein {

std::vector<double> gather_work(Communicator& ranks) {
  const double own = ranks.work_seconds();
  std::vector<double> all(static_cast<std::size_t>(ranks.size()));
  const std::vector<std::size_t> one_each(all.size(), 1);
  ranks.gather(&own, RankParts::behind_each_other(one_each), all.data());
  return all;
}

namespace {

template <class View>
void receive(Communicator& ranks, View& array, const int n, const char* label) {
  if (array.extent_int(0) != n) array = View(std::string(label), static_cast<std::size_t>(n));
  const auto mirror = Kokkos::create_mirror_view(array);
  ranks.broadcast(mirror.data(), mirror.size() * sizeof(double));
  Kokkos::deep_copy(array, mirror);
}

}  // namespace

void receive_vectors(Communicator& ranks, const int n, Vectors& vectors) {
  receive(ranks, vectors, n, "skein::receive_vectors");
}

void receive_nodes(Communicator& ranks, const SumOrder& order, OrderedNodes& nodes) {
  if (!order.are_held) {
    receive(ranks, nodes.position, order.n_sources, "skein::receive_nodes::position");
    receive(ranks, nodes.force, order.n_sources, "skein::receive_nodes::force");
  }
  if (order.are_same_nodes) {
    nodes.target = nodes.position;
  } else {
    if (nodes.target.data() == nodes.position.data()) nodes.target = {};
    receive(ranks, nodes.target, order.n_targets, "skein::receive_nodes::target");
  }
  if (!order.has_one_blob) return receive(ranks, nodes.blob, order.n_sources, "skein::receive_nodes::blob");
  if (nodes.blob.extent_int(0) != order.n_sources)
    nodes.blob = Scalars("skein::receive_nodes::blob", static_cast<std::size_t>(order.n_sources));
  Kokkos::deep_copy(nodes.blob, order.blob);
}

namespace {

/// A fast multipole sum on a rank that serves, and the step that it has been told of.
struct ServedFmmSum {
  std::unique_ptr<FmmSum> sum;
  std::int64_t n_steps = 0;
};

/// The loop of the other ranks.
class SumServer {
 public:
  SumServer(Communicator& ranks, const std::function<void(const Vectors& force)>& look) : ranks_(ranks), look_(look) {}

  /// @returns false once dismissed
  bool serve_next() {
    ranks_.broadcast(&order_, sizeof order_);
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
        receive_nodes(ranks_, order_, nodes_);
        ranks_.begin_work(RankWork::direct_sum);
        if (look_) look_(nodes_.force);
        direct_.add_velocity(ranks_, nodes_.sources(), nodes_.target, {}, order_.viscosity, order_.precision,
                             order_.by_teams);
        return true;
      case SumOrder::Kind::take_nodes:
        receive_nodes(ranks_, order_, nodes_);
        ranks_.begin_work(RankWork::taking_nodes);
        if (look_) look_(nodes_.force);
        take_nodes(sums_[order_.fmm_sum]);
        return true;
      case SumOrder::Kind::compute_fmm:
        ranks_.begin_work(RankWork::fmm_sum);
        sums_.at(order_.fmm_sum).sum->compute(order_.options, order_.plan, order_.viscosity);
        ranks_.end_work();
        return true;
    }
    throw Error(ExitCode::internal, "an order of no known kind");
  }
  int exit_code() const { return order_.exit_code; }

 private:
  void know_scene() {
    std::string text(order_.n_bytes, ' ');
    ranks_.broadcast(text.data(), text.size());
    scenes_.erase(order_.scene);
    scenes_.try_emplace(order_.scene, read_scene_text(text, "the scene of rank 0", {}, {}).config, ranks_.size());
  }
  void compute_forces() {
    const ForceShare& share = scenes_.at(order_.scene);
    const bool are_changes = order_.kind == SumOrder::Kind::compute_force_changes;
    receive_vectors(ranks_, order_.n_sources, nodes_.position);
    if (are_changes) receive_vectors(ranks_, order_.n_sources, nodes_.displacement);
    if (nodes_.force.extent_int(0) != order_.n_sources)
      nodes_.force = Vectors("skein::SumServer::force", static_cast<std::size_t>(order_.n_sources));
    ForceShare::compute(ranks_, share.nodes, share.forces, order_.time, nodes_.position,
                        are_changes ? ConstVectors(nodes_.displacement) : ConstVectors(), nodes_.force);
  }
  void take_nodes(ServedFmmSum& served) {
    if (served.sum == nullptr) served.sum = make_fmm_sum(KernelPath::host, &ranks_);
    if (served.n_steps != order_.n_steps) served.sum->begin_step();
    served.n_steps = order_.n_steps;
    if (!order_.is_in_step) served.sum->end_step();
    served.sum->take(nodes_.sources(), nodes_.target);
    ranks_.end_work();
  }

  Communicator& ranks_;
  const std::function<void(const Vectors& force)>& look_;
  SumOrder order_;
  OrderedNodes nodes_;
  DirectShare direct_;
  std::map<int, ServedFmmSum> sums_;
  std::map<int, ForceShare> scenes_;
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
