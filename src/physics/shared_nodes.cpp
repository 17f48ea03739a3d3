#include "shared_nodes.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/physics.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

void OwnedNodes::drop_unused() {
  for (auto next = parts_.begin(); next != parts_.end();) {
    const auto part = next++;
    if (part->second.own.use_count() > 1) continue;
    note_change(part->second);
    link_.note(make_work(PartWork::Kind::drop, part->second));
    parts_.erase(part);
  }
}

Vectors OwnedNodes::make(const std::string& label, const int n_nodes) {
  SKEIN_REQUIRE(static_cast<std::size_t>(n_nodes) == owners_.total(), "arrays are on all nodes of the scene");
  drop_unused();
  const Part part{next_number_++, make_part(label, owners_, 0), {}};
  link_.has_parts = true;
  link_.note(make_work(PartWork::Kind::make, part));
  parts_[part.own.data()] = part;
  return part.own;
}

Vectors OwnedNodes::find_room() {
  for (const Vectors& room : rooms_)
    if (room.use_count() == 1) return room;
  rooms_.emplace_back("skein::OwnedNodes::whole", owners_.total());
  return rooms_.back();
}

void OwnedNodes::combine(const Vectors& result, const std::initializer_list<Term<ExecSpace>> terms) {
  Part& part = part_of(result);
  PartWork work = make_work(PartWork::Kind::combine, part);
  SKEIN_REQUIRE(terms.size() <= PartWork::most_terms, "a combination of more terms than ranks are told");
  for (const Term<ExecSpace>& term : terms) {
    work.source[work.n_terms] = part_of(term.vectors).number;
    work.factor[work.n_terms++] = term.factor;
  }
  NodeVectors::combine(result, terms);
  note_change(part);
  link_.note(work);
}

void OwnedNodes::copy(const Vectors& to, const ConstVectors& from) {
  Part &target = part_of(to), &source = part_of(from);
  if (&target == &source) return;
  PartWork work = make_work(PartWork::Kind::copy, target);
  work.source[0] = source.number;
  work.n_terms = 1;
  NodeVectors::copy(to, from);
  note_change(target);
  look_for_whole(source);
  target.whole = source.whole;
  link_.note(work);
}

double OwnedNodes::root_mean_square(const ConstVectors& vectors) {
  const Part& part = part_of(vectors);
  send(SumOrder::Kind::norm_of_parts, part);
  return std::sqrt(add_up_squares(link_.ranks, owners_, part.own) / static_cast<double>(owners_.total()));
}

Vectors OwnedNodes::gather_part(Part& part) {
  look_for_whole(part);
  if (part.whole.data() == nullptr) {
    const Vectors room = find_room();
    send(SumOrder::Kind::gather_parts, part);
    gather_parts(link_.ranks, owners_, part.own, room);
    part.whole = room;
  }
  return part.whole;
}

void OwnedNodes::scatter(const ConstVectors& whole, const Vectors& vectors) {
  Part& part = part_of(vectors);
  const Vectors room = find_room();  // as it may be changed by whoever has it now
  Kokkos::deep_copy(ExecSpace(), room, whole);
  note_change(part);
  send(SumOrder::Kind::scatter_parts, part);
  scatter_parts(link_.ranks, owners_, room, part.own);
  part.whole = room;
}

bool OwnedNodes::serve(const Physics& physics) const {
  return physics.flow.get() == &flow_ && forces_->know(physics.forces) && physics.mobility->sums_by_ranks() &&
         physics.rigid_bodies.is_empty() && physics.symmetry == nullptr;
}

Sources OwnedNodes::compute_forces(const Physics& physics, const double time, const ConstVectors& position,
                                   const Vectors& velocity, const Vectors& force) {
  SKEIN_REQUIRE(serve(physics), "physics of which an integrator was made for ranks has been changed");
  Part &at = part_of(position), &result = part_of(velocity);
  note_change(result);
  link_.held = {};
  link_.own_forces = {};
  order_.time = time;
  order_.velocity = result.number;
  position_ = {};
  evaluated_ = nullptr;
  const Vectors all = find_room();
  send(SumOrder::Kind::evaluate, at);
  link_.ranks.begin_work(RankWork::forces);
  gather_parts_to_all(link_.ranks, owners_, at.own, all);
  position_ = all;
  evaluated_ = at.own.data();
  if (owners_.count[0] > 0) flow_.compute_velocity(time, own_rows(at.own), own_rows(velocity_));
  ForceShare::compute_own(link_.ranks, owners_, physics.forces, time, position_, {}, force);
  link_.own_forces = {&owners_, forces_->scene(), force};
  link_.held = {position_.data(), force.data(), position_.extent_int(0)};
  return {position_, force, physics.blob, true};
}

void OwnedNodes::add_velocity(const Physics& physics, const Sources& sources, const Vectors& velocity) {
  const Part& result = part_of(velocity);
  const std::size_t n_own = owners_.count[0], n_others = owners_.total() - n_own;
  const auto complete = [&] {
    if (n_others == 0) return;
    flow_.compute_velocity(order_.time, rows_of(position_, n_own, n_others), rows_of(velocity_, n_own, n_others));
  };
  Delivery delivery{owners_, forces_->scene(), result.number, velocity_, complete};
  struct Lent {
    TeamLink& link;
    ~Lent() {
      link.delivery = nullptr;
      link.own_forces = {};
    }
  };
  {
    const Lent lent{link_};
    link_.delivery = &delivery;
    physics.mobility->add_velocity(sources, sources.position, velocity_);
  }
  // Where positions are no numbers there was no sum, and all velocities are none.
  if (!delivery.is_done) return scatter(velocity_, velocity);
  Kokkos::deep_copy(ExecSpace(), own_rows(velocity), own_rows(velocity_));
}

}  // namespace skein
