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
  const Part part{next_number_++, make_part(label, owners_, 0), {}, ++last_content_};
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
  target.content = source.content;
  link_.note(work);
}

void OwnedNodes::set_to_zero(const Vectors& vectors) {
  Part& part = part_of(vectors);
  NodeVectors::set_to_zero(vectors);
  note_change(part);
  link_.note(make_work(PartWork::Kind::set_to_zero, part));
}

double OwnedNodes::dot_product(const ConstVectors& a, const ConstVectors& b) {
  const Part &left = part_of(a), &right = part_of(b);
  order_.other_array = right.number;
  send(SumOrder::Kind::dot_product_of_parts, left);
  return add_up_products(link_.ranks, owners_, left.own, right.own);
}

double OwnedNodes::root_mean_square(const ConstVectors& vectors) {
  return std::sqrt(dot_product(vectors, vectors) / static_cast<double>(owners_.total()));
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

/// All ranks have the positions that they need then. The order of an evaluation is filled in but for its kind.
void OwnedNodes::take_positions(const Physics& physics, Part& at) {
  // What the last sum did without, this one will do without. Where it does not, it asks.
  order_.are_local = link_.has_divided && !forces_->needed().are_all();
  order_.are_held = evaluated_ == at.content && link_.held_position == position_.data();
  link_.held = {};
  link_.own_forces = {};
  if (order_.are_held) return send(order_.kind, at);
  position_ = {};
  evaluated_ = -1;
  link_.forget_positions();
  const Vectors all = find_room();
  send(order_.kind, at);
  link_.ranks.begin_work(RankWork::forces);
  seen_.centroid =
      gather_for_forces(link_.ranks, owners_, forces_->needed(), physics.sections, order_.are_local, at.own, all);
  position_ = all;
  evaluated_ = at.content;
  link_.held_position = all.data();
  if (order_.are_local) link_.own_positions = {&owners_, forces_->scene(), all};
}

Sources OwnedNodes::compute_own_forces(const Physics& physics, const ConstVectors& displacement, const Vectors& force) {
  seen_.position = position_;
  seen_.displacement = displacement;
  ForceShare::compute_own(link_.ranks, owners_, physics.forces, order_.time, seen_, force);
  seen_.displacement = {};
  link_.own_forces = {&owners_, forces_->scene(), force};
  link_.held = {position_.data(), force.data(), position_.extent_int(0)};
  return {position_, force, physics.blob, true};
}

Sources OwnedNodes::compute_forces(const Physics& physics, const double time, const ConstVectors& position,
                                   const Vectors& velocity, const Vectors& force) {
  SKEIN_REQUIRE(serve(physics), "physics of which an integrator was made for ranks has been changed");
  Part &at = part_of(position), &result = part_of(velocity);
  note_change(result);
  order_.kind = SumOrder::Kind::evaluate;
  order_.time = time;
  order_.velocity = result.number;
  adds_to_flow_ = true;
  take_positions(physics, at);
  if (owners_.count[0] > 0) flow_.compute_velocity(time, own_rows(at.own), own_rows(velocity_));
  return compute_own_forces(physics, {}, force);
}

Sources OwnedNodes::compute_force_changes(const Physics& physics, const double time, const ConstVectors& position,
                                          const ConstVectors& displacement, const Vectors& velocity,
                                          const Vectors& force) {
  SKEIN_REQUIRE(serve(physics), "physics of which an integrator was made for ranks has been changed");
  Part &at = part_of(position), &result = part_of(velocity), &moved = part_of(displacement);
  note_change(result);
  order_.kind = SumOrder::Kind::evaluate_changes;
  order_.time = time;
  order_.velocity = result.number;
  order_.displacement = moved.number;
  adds_to_flow_ = false;
  take_positions(physics, at);
  const Vectors all = find_room();
  seen_.mean_displacement =
      gather_for_forces(link_.ranks, owners_, forces_->needed(), physics.sections, order_.are_local, moved.own, all);
  Kokkos::deep_copy(ExecSpace(), own_rows(velocity_), 0.0);
  return compute_own_forces(physics, all, force);
}

void OwnedNodes::add_velocity(const Physics& physics, const Sources& sources, const Vectors& velocity) {
  const Part& result = part_of(velocity);
  const std::size_t n_own = owners_.count[0], n_others = owners_.total() - n_own;
  const auto complete = [&] {
    if (n_others == 0) return;
    const Vectors rows = rows_of(velocity_, n_own, n_others);
    if (adds_to_flow_)
      flow_.compute_velocity(order_.time, rows_of(position_, n_own, n_others), rows);
    else
      Kokkos::deep_copy(ExecSpace(), rows, 0.0);
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
