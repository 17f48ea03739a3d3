#include <skein/core/error.hpp>
#include <skein/physics/sum_team.hpp>

#include "direct_share.hpp"
#include "force_share.hpp"
#include "kernels/node_checks.hpp"
#include "node_parts.hpp"
#include "shared_nodes.hpp"
#include "sum_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace skein {
namespace {

/// Whether ranks make a part of the tree each: where the whole one, 45 ns a node, takes longer than a part, 1.6 times
/// as long a node, and what has to be said about parts, 0.6 ms (docs/hydrodynamics.md, "Ranks"). No bit depends on it.
bool divide_tree(const std::size_t n_nodes, const int n_ranks) {
  return static_cast<double>(n_nodes) * (1.0 - 1.6 / n_ranks) > 15000.0;
}

}  // namespace

struct SumTeam::Parts {
  TeamLink link;
  DirectShare direct;
  /// That there are; those that are gone leave their numbers, and what they have on other ranks.
  std::set<int> fmm_sums, scenes;
  std::string partition;
};

/// Rank 0's side of a sum that all ranks compute.
class SumTeam::SharedFmmSum final : public FmmSum {
 public:
  SharedFmmSum(Parts& team, const KernelPath path)
      : team_(team), link_(team.link), inner_(skein::make_fmm_sum(path, &team.link.ranks)) {
    order_.path = path;
    while (!team.fmm_sums.insert(order_.fmm_sum).second) ++order_.fmm_sum;
  }
  ~SharedFmmSum() override { team_.fmm_sums.erase(order_.fmm_sum); }

  bool take(const Sources& sources, const ConstVectors& target) override {
    order_.kind = SumOrder::Kind::take_nodes;
    const std::size_t n = sources.position.extent(0);
    const int n_ranks = link_.ranks.size();
    order_.is_divided = on_host<ExecSpace> && order_.path != KernelPath::device &&
                        are_same_nodes(sources.position, target) && divide_tree(n, n_ranks);
    order_.is_delivered = link_.delivery != nullptr;
    if (order_.is_delivered) order_.scene = link_.delivery->scene;
    send_nodes(link_, order_, sources, target);
    order_.is_new_sum = false;
    if (!order_.is_divided) return inner_->take(sources, target);
    const RankParts parts = order_.is_delivered ? link_.delivery->owners : RankParts::evenly(n, n_ranks);
    return inner_->take_part(rows_of(sources, 0, parts.count[0]), parts);
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
    order_.is_delivered = link_.delivery != nullptr;
    inner_->owners = {};
    if (link_.delivery != nullptr) {
      order_.scene = link_.delivery->scene;
      inner_->owners = link_.delivery->owners;
    }
    link_.send(order_);
    link_.ranks.begin_work(RankWork::fmm_sum);
    const bool is_done = inner_->compute(options, plan, viscosity);
    link_.ranks.end_work();
    statistics = inner_->statistics;
    team_.partition = fmt::format("{} leaves along the tree{}", statistics.n_leaves,
                                  order_.is_divided ? ", of which each rank has a part" : "");
    return is_done;
  }
  void add_to(const Vectors& velocity) const override {
    if (!order_.is_delivered) return inner_->add_to(velocity);
    Delivery* const delivery = link_.delivery;
    SKEIN_REQUIRE(delivery != nullptr && delivery->room.data() == velocity.data(),
                  "a sum is added to what it was computed for");
    inner_->add_to(delivery->own_rows());
    PartWork work;
    work.kind = PartWork::Kind::add_fmm_sum;
    work.scene = delivery->scene;
    work.result = delivery->velocity;
    work.source[0] = order_.fmm_sum;
    link_.note(work);
    delivery->is_done = true;
  }
  std::vector<Vec3> sample(const EvenSample& sample) const override {
    if (!order_.is_delivered) return inner_->sample(sample);
    SumOrder order = order_;
    order.kind = SumOrder::Kind::sample_fmm;
    order.n_sampled = sample.n;
    order.n_chosen = sample.n_chosen;
    link_.send(order);
    return gather_sample(link_.ranks, inner_->owners, *inner_, sample);
  }

 private:
  Parts& team_;
  TeamLink& link_;
  std::unique_ptr<FmmSum> inner_;
  SumOrder order_;
};

SumTeam::SumTeam(Communicator& ranks) : parts_(std::make_unique<Parts>(Parts{TeamLink(ranks), {}, {}, {}, {}})) {}
SumTeam::~SumTeam() = default;

const Communicator& SumTeam::ranks() const { return parts_->link.ranks; }

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
  Delivery* delivery = parts_->link.delivery;
  if (delivery != nullptr && delivery->room.data() != velocity.data()) delivery = nullptr;
  order.is_delivered = delivery != nullptr;
  if (delivery != nullptr) {
    order.scene = delivery->scene;
    order.velocity = delivery->velocity;
    delivery->is_done = true;
  }
  send_nodes(parts_->link, order, sources, target);
  parts_->direct.add_velocity(parts_->link.ranks, sources, target,
                              delivery == nullptr ? velocity : delivery->own_rows(), viscosity, precision, by_teams,
                              delivery == nullptr ? nullptr : &delivery->owners);
  parts_->partition = parts_->direct.partition();
}

std::unique_ptr<FmmSum> SumTeam::make_fmm_sum(const KernelPath path) {
  return std::make_unique<SharedFmmSum>(*parts_, path);
}

std::shared_ptr<SharedForces> SumTeam::share_forces(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                                    const std::vector<std::unique_ptr<Force>>& forces) {
  if (parts_->link.ranks.size() == 1) return nullptr;
  return std::make_shared<SharedForces>(parts_->link, parts_->scenes, scene, fibers, forces);
}

std::shared_ptr<SharedNodes> SumTeam::share_nodes(const std::shared_ptr<SharedForces>& forces,
                                                  const BackgroundFlow& flow) {
  if (forces == nullptr) return nullptr;
  return std::make_shared<OwnedNodes>(parts_->link, forces, flow);
}

void SumTeam::complete(const Vectors& velocity) {
  const Delivery* const delivery = parts_->link.delivery;
  if (delivery != nullptr && delivery->room.data() == velocity.data()) delivery->complete();
}

void SumTeam::complete(const Sources& sources) { parts_->link.complete(sources); }

bool SumTeam::advances_parts() const { return parts_->link.has_parts; }

const std::string& SumTeam::partition() const { return parts_->partition; }

std::vector<double> SumTeam::work_seconds() {
  SumOrder order;
  order.kind = SumOrder::Kind::tell_work;
  parts_->link.send(order);
  return gather_work(parts_->link.ranks);
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
