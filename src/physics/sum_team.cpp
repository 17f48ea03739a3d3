#include <skein/core/error.hpp>
#include <skein/physics/sum_team.hpp>
#include <skein/ranks/rank_error.hpp>

#include "direct_share.hpp"
#include "sum_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <set>

namespace skein {
namespace {

RankParts one_each(const Communicator& ranks) {
  return RankParts::behind_each_other(std::vector<std::size_t>(static_cast<std::size_t>(ranks.size()), 1));
}

std::vector<double> gather_work(Communicator& ranks) {
  const double own = ranks.work_seconds();
  std::vector<double> all(static_cast<std::size_t>(ranks.size()));
  ranks.gather(&own, one_each(ranks), all.data());
  return all;
}

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
      case SumOrder::Kind::add_direct:
        receive_nodes(ranks_, order_, nodes_);
        ranks_.begin_work();
        if (look_) look_(nodes_.force);
        direct_.add_velocity(ranks_, nodes_.sources(), nodes_.target, {}, order_.viscosity, order_.precision,
                             order_.by_teams);
        return true;
      case SumOrder::Kind::take_nodes:
        receive_nodes(ranks_, order_, nodes_);
        ranks_.begin_work();
        if (look_) look_(nodes_.force);
        take_nodes(sums_[order_.fmm_sum]);
        return true;
      case SumOrder::Kind::compute_fmm:
        ranks_.begin_work();
        sums_.at(order_.fmm_sum).sum->compute(order_.options, order_.plan, order_.viscosity);
        ranks_.end_work();
        return true;
    }
    throw Error(ExitCode::internal, "an order of no known kind");
  }
  int exit_code() const { return order_.exit_code; }

 private:
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
};

}  // namespace

struct SumTeam::Parts {
  Communicator& ranks;
  DirectShare direct;
  std::set<int>
      fmm_sums;  ///< that there are; those that are gone leave their numbers, and what they have on other ranks
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
    send_nodes(ranks_, order_, sources, target);
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
    ranks_.begin_work();
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

SumTeam::SumTeam(Communicator& ranks) : parts_(std::make_unique<Parts>(Parts{ranks, {}, {}, {}})) {}
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
  send_nodes(parts_->ranks, order, sources, target);
  parts_->direct.add_velocity(parts_->ranks, sources, target, velocity, viscosity, precision, by_teams);
  parts_->partition = parts_->direct.partition();
}

std::unique_ptr<FmmSum> SumTeam::make_fmm_sum(const KernelPath path) {
  const bool is_on_host = path == KernelPath::automatic ? on_host<ExecSpace> : path == KernelPath::host;
  // Of a device's sum rank 0 has all.
  if (!is_on_host) return skein::make_fmm_sum(path);
  return std::make_unique<SharedFmmSum>(*parts_);
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
