#include <skein/core/error.hpp>
#include <skein/dynamics/fiber_linearization.hpp>
#include <skein/fibers/start_shape.hpp>

#include "dynamics/near_damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein {
namespace {

// Of sections to either side. Wider bands save iterations, but cost more than those (N_f = 80 and 113); where sums are
// cheap, beside the matrix, a narrow band takes 0.5 to 0.8 of the time, with 1.0 to 1.5 times as many iterations
// (docs/time_stepping.md).
constexpr int usual_near_sections = 5, narrow_near_sections = 1;
constexpr double cheap_sum = 0.5;  // over a direct one
constexpr double narrow_iterations = 1.5;
// At the speed at which pairs are summed.
constexpr double pair_operations = 16.0;
constexpr double spring_operations = 50.0;

Vec3 normalize(const Vec3 v, const Vec3 otherwise) {
  const double length = norm(v);
  return length > 0.0 ? v / length : otherwise;
}

}  // namespace

FiberLinearization::FiberLinearization(const std::vector<Fiber>& fibers, const double viscosity,
                                       const double relative_sum_cost, Product product, VectorsOf vectors_of,
                                       std::shared_ptr<const NodeSymmetry> symmetry)
    : fibers_(fibers),
      networks_(make_spring_networks(fibers)),
      viscosity_(viscosity),
      product_(std::move(product)),
      vectors_of_(std::move(vectors_of)),
      symmetry_(std::move(symmetry)),
      n_nodes_(count_nodes(fibers)),
      near_sections_(relative_sum_cost < cheap_sum ? narrow_near_sections : usual_near_sections),
      evaluation_operations_(pair_operations * n_nodes_ * n_nodes_ * relative_sum_cost +
                             spring_operations * static_cast<double>(count_springs(networks_))) {
  for (const SpringNetwork& network : networks_)
    bands_.push_back(std::make_unique<BlockBand>(network.n_sections, 3 * network.stencil.nodes_per_section,
                                                 near_sections_ + network.stencil.reach));
}

FiberLinearization::~FiberLinearization() = default;

std::vector<FiberLinearization::Frame> FiberLinearization::make_frames(const std::vector<Vec3>& position) const {
  std::vector<Frame> frames;
  for (const Fiber& fiber : fibers_) {
    const int n = fiber.config.nodes_per_section, n_sections = fiber.config.sections;
    std::vector<Vec3> centre(n_sections);
    for (int s = 0; s < n_sections; ++s) {
      for (int a = 0; a < n; ++a) centre[s] = centre[s] + position[fiber.first_node + s * n + a];
      centre[s] = centre[s] / static_cast<double>(n);
    }
    for (int s = 0; s < n_sections; ++s) {
      Frame frame;
      frame.axis[0] = normalize(centre[std::min(s + 1, n_sections - 1)] - centre[std::max(s - 1, 0)], {1.0, 0.0, 0.0});
      const Vec3 to_node = position[fiber.first_node + s * n] - centre[s];
      // A chain has no node beside its centreline: any direction across serves, it resists all bends alike.
      frame.axis[1] = n == 1 ? make_fiber_axes(frame.axis[0], 0.0).angle_0
                             : normalize(to_node - dot(to_node, frame.axis[0]) * frame.axis[0], {0.0, 1.0, 0.0});
      frame.axis[2] = cross(frame.axis[0], frame.axis[1]);
      frames.push_back(frame);
    }
  }
  return frames;
}

void FiberLinearization::set_position(const double time, const ConstVectors& position) {
  time_ = time;
  NodeVectors& nodes = vectors_of_(position);
  if (position_.data() == nullptr || &vectors_of_(position_) != &nodes)
    position_ = nodes.make("skein::FiberLinearization::position", n_nodes_);
  nodes.copy(position_, position);
  frames_ = make_frames(to_host(nodes.gather_whole(position)));
  update_turns();
}

// Rotations that take the frames of the factorization into those of now: sum of axis(now) axis(then)^T.
void FiberLinearization::update_turns() {
  turns_.clear();
  if (frames_at_factorization_.empty() || frames_.empty()) return;
  for (std::size_t s = 0; s < frames_.size(); ++s) {
    Frame turn;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 now = frames_[s].axis[axis], then = frames_at_factorization_[s].axis[axis];
      turn.axis[0] = turn.axis[0] + now.x * then;
      turn.axis[1] = turn.axis[1] + now.y * then;
      turn.axis[2] = turn.axis[2] + now.z * then;
    }
    turns_.push_back(turn);
  }
}

void FiberLinearization::multiply(const ConstVectors& v, const Vectors& result) {
  product_(time_, position_, v, result);
}

bool FiberLinearization::factorize(const ConstVectors& position, const double scale) {
  const std::vector<Vec3> list = to_host(vectors_of_(position).gather_whole(position));
  frames_at_factorization_.clear();
  for (std::size_t f = 0; f < fibers_.size(); ++f) {
    const SpringStencil& stencil = networks_[f].stencil;
    std::vector<double> inverse_rest_length;
    for (std::size_t entry = 0; entry < stencil.stiffness.size(); ++entry)
      inverse_rest_length.push_back(stencil.stiffness[entry] > 0.0 ? 1.0 / stencil.rest_length[entry] : 1.0);
    const NearFiber fiber{
        .n_sections = networks_[f].n_sections,
        .nodes_per_section = stencil.nodes_per_section,
        .reach = stencil.reach,
        .stiffness = stencil.stiffness.data(),
        .inverse_rest_length = inverse_rest_length.data(),
        .section_factor = networks_[f].section_factor.empty() ? nullptr : networks_[f].section_factor.data(),
        .blob = fibers_[f].config.blob,
        .viscosity = viscosity_};
    const auto first = list.begin() + fibers_[f].first_node;
    compute_near_damping(fiber, {first, first + fibers_[f].n_nodes()}, near_sections_, scale, *bands_[f]);
    if (!bands_[f]->factorize()) return false;
  }
  frames_at_factorization_ = make_frames(list);
  update_turns();
  return true;
}

PreconditionerCost FiberLinearization::preconditioner_cost() const {
  constexpr double slowness = 4.0;  // every number of the matrix comes from memory for a single use
  double factorization = 0.0, use = 0.0;
  for (const auto& band : bands_) {
    const double size = band->block_size(), width = band->half_width();
    factorization += 2.0 * band->n_rows() * size * size * size * (width * width + 7.0 * width + 4.0);
    use += slowness * 2.0 * band->n_rows() * size * size * (2.0 * width + 1.0);
  }
  return {factorization / evaluation_operations_, use / evaluation_operations_,
          near_sections_ < usual_near_sections ? narrow_iterations : 1.0};
}

void FiberLinearization::precondition(const ConstVectors& v, const Vectors& result) {
  SKEIN_REQUIRE(!turns_.empty(), "factorize and set_position come first");
  NodeVectors& nodes = vectors_of_(v);
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), nodes.gather_whole(v));
  const Vectors whole = nodes.make_room_for_whole(result);
  const auto out = Kokkos::create_mirror_view(whole);
  std::vector<double> x;
  std::size_t section = 0;
  for (std::size_t f = 0; f < fibers_.size(); ++f) {
    const Fiber& fiber = fibers_[f];
    const int n = fiber.config.nodes_per_section, first = fiber.first_node;
    x.resize(3 * static_cast<std::size_t>(fiber.n_nodes()));
    for (int i = 0; i < fiber.n_nodes(); ++i) {
      const Frame& turn = turns_[section + i / n];
      const Vec3 y = load(host, first + i);
      const Vec3 back = y.x * turn.axis[0] + y.y * turn.axis[1] + y.z * turn.axis[2];
      x[3 * i] = back.x;
      x[3 * i + 1] = back.y;
      x[3 * i + 2] = back.z;
    }
    bands_[f]->solve(x.data());
    for (int i = 0; i < fiber.n_nodes(); ++i) {
      const Frame& turn = turns_[section + i / n];
      const Vec3 y{x[3 * i], x[3 * i + 1], x[3 * i + 2]};
      store(out, first + i, {dot(turn.axis[0], y), dot(turn.axis[1], y), dot(turn.axis[2], y)});
    }
    section += fiber.config.sections;
  }
  Kokkos::deep_copy(ExecSpace(), whole, out);
  if (symmetry_ != nullptr) symmetry_->project(whole);
  nodes.scatter(whole, result);
  ExecSpace().fence();
}

std::string FiberLinearization::describe() const {
  return fmt::format(
      "springs and near mobility of {} section{} to either side, banded, factorized anew when it is worth it",
      near_sections_, near_sections_ == 1 ? "" : "s");
}

}  // namespace skein
