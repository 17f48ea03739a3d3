#include <fmt/format.h>

#include <skein/core/error.hpp>
#include <skein/model/linear_flow.hpp>

namespace skein {
namespace {

/// The gradient by rows, as a kernel can capture it.
struct Rows {
  Vec3 x, y, z;
};

Vec3 as_vector(const std::array<double, 3>& row) { return {row[0], row[1], row[2]}; }

void add_linear_flow(const Rows& gradient, const Vec3 origin, const ConstVectors& position, const Vectors& velocity) {
  Kokkos::parallel_for(
      "skein::add_linear_flow", Kokkos::RangePolicy<ExecSpace>(0, position.extent_int(0)), KOKKOS_LAMBDA(const int i) {
        const Vec3 d = load(position, i) - origin;
        store(velocity, i, load(velocity, i) + Vec3{dot(gradient.x, d), dot(gradient.y, d), dot(gradient.z, d)});
      });
}

}  // namespace

VelocityGradient make_shear_gradient(const double rate) {
  return {{{0.0, rate, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
}

VelocityGradient make_planar_extension_gradient(const double rate) {
  return {{{-rate, 0.0, 0.0}, {0.0, rate, 0.0}, {0.0, 0.0, 0.0}}};
}

void LinearFlow::add_velocity(double /*time*/, const ConstVectors& position, const Vectors& velocity) const {
  SKEIN_REQUIRE(position.extent(0) == velocity.extent(0), "positions and velocities differ in number");
  add_linear_flow({as_vector(gradient_[0]), as_vector(gradient_[1]), as_vector(gradient_[2])}, origin_, position,
                  velocity);
}

std::string LinearFlow::describe() const {
  if (gradient_ == make_shear_gradient(gradient_[0][1]))
    return fmt::format("shear u = ({:g} (y - {:g}), 0, 0)", gradient_[0][1], origin_.y);
  const auto row = [](const std::array<double, 3>& g) { return fmt::format("[{:g}, {:g}, {:g}]", g[0], g[1], g[2]); };
  return fmt::format("linear flow u = G (x - ({:g}, {:g}, {:g})), G = [{}, {}, {}]", origin_.x, origin_.y, origin_.z,
                     row(gradient_[0]), row(gradient_[1]), row(gradient_[2]));
}

}  // namespace skein
