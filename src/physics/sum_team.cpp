#include <skein/core/error.hpp>
#include <skein/physics/sum_team.hpp>

#include "direct_share.hpp"
#include "force_share.hpp"
#include "kernels/node_checks.hpp"
#include "sum_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace skein {

void send_vectors(Communicator& ranks, const ConstVectors& vectors) {
  // Some nodes of an array have gaps between their components.
  ConstVectors packed = vectors;
  if (!vectors.span_is_contiguous()) {
    const Vectors copy("skein::send_vectors::packed", vectors.extent(0));
    Kokkos::deep_copy(copy, vectors);
    packed = copy;
  }
  const auto on_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), packed);
  // Of rank 0 nothing is changed.
  ranks.broadcast(const_cast<double*>(on_host.data()), on_host.size() * sizeof(double));
}

void send_nodes(Communicator& ranks, SumOrder& order, const Sources& sources, const ConstVectors& target,
                HeldNodes& held) {
  order.n_sources = sources.position.extent_int(0);
  order.n_targets = target.extent_int(0);
  order.are_same_nodes = are_same_nodes(sources.position, target);
  if (order.n_sources > 0) {
    const BlobRange blobs = find_blob_range<ExecSpace>(ExecSpace(), sources.blob);
    order.has_one_blob = blobs.smallest == blobs.largest;
    order.blob = blobs.largest;
  }
  order.are_held = held.are(sources);
  held = {};
  ranks.broadcast(&order, sizeof order);
  if (!order.are_held) {
    send_vectors(ranks, sources.position);
    send_vectors(ranks, sources.force);
  }
  if (!order.are_same_nodes) send_vectors(ranks, target);
  if (order.has_one_blob) return;
  const auto blob = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.blob);
  ranks.broadcast(const_cast<double*>(blob.data()), blob.size() * sizeof(double));
}

struct SumTeam::Parts {
  Communicator& ranks;
  DirectShare direct;
  /// That there are; those that are gone leave their numbers, and what they have on other ranks.
  std::set<int> fmm_sums, scenes;
  HeldNodes held;
  std::string partition;
};

/// Rank 0's side of a sum that all ranks compute.
class SumTeam::SharedFmmSum final : public FmmSum {
 public:
  explicit SharedFmmSum(Parts& team)
      : team_(team), ranks_(team.ranks), inner_(skein::make_fmm_sum(KernelPath::host, &team.ranks)) {
    while (!team.fmm_sums.insert(order_.fmm_sum).second) ++order_.fmm_sum;
  }
  ~SharedFmmSum() override { team_.fmm_sums.erase(order_.fmm_sum); }

  bool take(const Sources& sources, const ConstVectors& target) override {
    order_.kind = SumOrder::Kind::take_nodes;
    send_nodes(ranks_, order_, sources, target, team_.held);
    return inner_->take(sources, target);
  }
  double largest_blob() const override { return inner_->largest_blob(); }
  void begin_step() override {
    ++order_.n_steps;
    order_.is_in_step = true;
    inner_->begin_step();
  }
  void end_step() noexcept override {
    order_.is_in_step = false;
    inner_->end_step();
  }
  bool compute(const FmmOptions& options, const FmmPlan& plan, const double viscosity) override {
    order_.kind = SumOrder::Kind::compute_fmm;
    order_.options = options;
    order_.plan = plan;
    order_.viscosity = viscosity;
    ranks_.broadcast(&order_, sizeof order_);
    ranks_.begin_work(RankWork::fmm_sum);
    const bool is_done = inner_->compute(options, plan, viscosity);
    ranks_.end_work();
    statistics = inner_->statistics;
    team_.partition = fmt::format("{} leaves along the tree", statistics.n_leaves);
    return is_done;
  }
  void add_to(const Vectors& velocity) const override { inner_->add_to(velocity); }
  std::vector<Vec3> sample(const EvenSample& sample) const override { return inner_->sample(sample); }

 private:
  Parts& team_;
  Communicator& ranks_;
  std::unique_ptr<FmmSum> inner_;
  SumOrder order_;
};

SumTeam::SumTeam(Communicator& ranks) : parts_(std::make_unique<Parts>(Parts{ranks, {}, {}, {}, {}, {}})) {}
SumTeam::~SumTeam() = default;

const Communicator& SumTeam::ranks() const { return parts_->ranks; }

void SumTeam::add_direct(const Sources& sources, const ConstVectors& target, const Vectors& velocity,
                         const double viscosity, const Precision precision, const bool by_teams) {
  SKEIN_REQUIRE(
      sources.position.extent(0) == sources.force.extent(0) && sources.position.extent(0) == sources.blob.extent(0),
      "positions, forces and blobs of the sources differ in number");
  SKEIN_REQUIRE(target.extent(0) == velocity.extent(0), "targets and velocities differ in number");
  if (sources.position.extent(0) == 0 || target.extent(0) == 0) return;
  SumOrder order;
  order.kind = SumOrder::Kind::add_direct;
  order.viscosity = viscosity;
  order.precision = precision;
  order.by_teams = by_teams;
  send_nodes(parts_->ranks, order, sources, target, parts_->held);
  parts_->direct.add_velocity(parts_->ranks, sources, target, velocity, viscosity, precision, by_teams);
  parts_->partition = parts_->direct.partition();
}

std::unique_ptr<FmmSum> SumTeam::make_fmm_sum(const KernelPath path) {
  const bool is_on_host = path == KernelPath::automatic ? on_host<ExecSpace> : path == KernelPath::host;
  // Of a device's sum rank 0 has all.
  if (!is_on_host) return skein::make_fmm_sum(path);
  return std::make_unique<SharedFmmSum>(*parts_);
}

std::shared_ptr<SharedForces> SumTeam::share_forces(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                                    const std::vector<std::unique_ptr<Force>>& forces) {
  if (!on_host<ExecSpace> || parts_->ranks.size() == 1) return nullptr;
  return std::make_shared<SharedForces>(parts_->ranks, parts_->held, parts_->scenes, scene, fibers, forces);
}

const std::string& SumTeam::partition() const { return parts_->partition; }

std::vector<double> SumTeam::work_seconds() {
  SumOrder order;
  order.kind = SumOrder::Kind::tell_work;
  parts_->ranks.broadcast(&order, sizeof order);
  return gather_work(parts_->ranks);
}

std::string describe_balance(const std::vector<double>& seconds) {
  double sum = 0.0, most = 0.0;
  for (const double s : seconds) {
    sum += s;
    most = std::max(most, s);
  }
  if (!(most > 0.0)) return "no work was shared";
  return fmt::format("the busiest rank had {:.3g} times the mean work",
                     most * static_cast<double>(seconds.size()) / sum);
}

void dismiss_ranks(Communicator& ranks, const int exit_code) {
  SumOrder order;
  order.exit_code = exit_code;
  ranks.broadcast(&order, sizeof order);
}

}  // namespace skein
