#pragma once

#include <skein/physics/background_flow.hpp>
#include <skein/physics/shared_nodes.hpp>

#include "force_share.hpp"
#include "node_parts.hpp"
#include "sum_order.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace skein {

/// Rank 0's side, as it tells the others.
class OwnedNodes final : public SharedNodes {
 public:
  /// @param link  of the team, which must outlive the object  @param flow  that ranks know, too
  OwnedNodes(TeamLink& link, const std::shared_ptr<SharedForces>& forces, const BackgroundFlow& flow)
      : link_(link),
        forces_(forces),
        flow_(flow),
        owners_(forces->nodes()),
        velocity_(Kokkos::view_alloc(std::string("skein::OwnedNodes::velocity"), Kokkos::WithoutInitializing),
                  owners_.total()) {}

  Vectors make(const std::string& label, int n_nodes) override;
  Vectors make_like(const std::string& label, const Vectors&) override {
    return make(label, static_cast<int>(owners_.total()));
  }
  void combine(const Vectors& result, std::initializer_list<Term<ExecSpace>> terms) override;
  void copy(const Vectors& to, const ConstVectors& from) override;
  void set_to_zero(const Vectors& vectors) override;
  double dot_product(const ConstVectors& a, const ConstVectors& b) override;
  double root_mean_square(const ConstVectors& vectors) override;
  Vectors gather(const Vectors& vectors) override { return gather_part(part_of(vectors)); }
  void scatter(const ConstVectors& whole, const Vectors& vectors) override;
  Vectors make_room_for_whole(const Vectors&) override { return find_room(); }

  bool serve(const Physics& physics) const override;
  ConstVectors gather_whole(const ConstVectors& vectors) override { return gather_part(part_of(vectors)); }
  bool have_made(const ConstVectors& vectors) const override { return parts_.count(vectors.data()) > 0; }
  Sources compute_forces(const Physics& physics, double time, const ConstVectors& position, const Vectors& velocity,
                         const Vectors& force) override;
  Sources compute_force_changes(const Physics& physics, double time, const ConstVectors& position,
                                const ConstVectors& displacement, const Vectors& velocity,
                                const Vectors& force) override;
  void add_velocity(const Physics& physics, const Sources& sources, const Vectors& velocity) override;

 private:
  struct Part {
    int number = 0;
    Vectors own;
    Vectors whole;             ///< of all ranks, as long as it is known here; never changed
    std::int64_t content = 0;  ///< arrays with the same number are equal
  };

  Part& part_of(const ConstVectors& vectors) {
    const auto found = parts_.find(vectors.data());
    SKEIN_REQUIRE(found != parts_.end(), "an array that is not on the nodes of ranks");
    return found->second;
  }
  Vectors own_rows(const Vectors& part) const { return skein::own_rows(part, owners_, 0); }
  void note_change(Part& part) {
    part.whole = {};
    part.content = ++last_content_;
  }
  void look_for_whole(Part& part) const {
    const bool is_whole = link_.held_position == position_.data() && !link_.own_positions.are(position_);
    if (part.whole.data() == nullptr && evaluated_ == part.content && is_whole) part.whole = position_;
  }
  PartWork make_work(const PartWork::Kind kind, const Part& result) const {
    PartWork work;
    work.kind = kind;
    work.scene = forces_->scene();
    work.result = result.number;
    return work;
  }
  void send(const SumOrder::Kind kind, const Part& part) {
    order_.kind = kind;
    order_.scene = forces_->scene();
    order_.array = part.number;
    link_.send(order_);
  }
  Vectors gather_part(Part& part);
  Vectors find_room();
  void take_positions(const Physics& physics, Part& at);
  Sources compute_own_forces(const Physics& physics, const ConstVectors& displacement, const Vectors& force);
  void drop_unused();

  TeamLink& link_;
  std::shared_ptr<SharedForces> forces_;
  const BackgroundFlow& flow_;
  RankParts owners_;
  std::unordered_map<const double*, Part> parts_;  ///< by where rank 0's rows are
  int next_number_ = 0;
  SumOrder order_;
  std::vector<Vectors> rooms_;     ///< for whole arrays; those that nobody else holds are free
  Vectors position_;               ///< in the last evaluation, of all nodes or as far as needed for own forces
  SeenNodes seen_;                 ///< then, for forces
  std::int64_t last_content_ = 0;  ///< of arrays
  std::int64_t evaluated_ = -1;    ///< that of the positions; -1: none was
  bool adds_to_flow_ = true;       ///< in the last evaluation: else to zeros
  Vectors velocity_;               ///< of all nodes; the memory of others' is only touched where they are looked at
};

}  // namespace skein
