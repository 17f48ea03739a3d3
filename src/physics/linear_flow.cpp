#include <skein/core/error.hpp>
#include <skein/physics/linear_flow.hpp>

#include "kernels/flow_velocity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

Vec3 as_vector(const std::array<double, 3>& row) { return {row[0], row[1], row[2]}; }

}  // namespace

void LinearFlow::add_velocity(double /*time*/, const ConstVectors& position, const Vectors& velocity) const {
  FlowTerms terms;
  terms.n_terms = 1;
  terms.term[0].origin = origin_;
  terms.term[0].gradient_x = as_vector(gradient_[0]);
  terms.term[0].gradient_y = as_vector(gradient_[1]);
  terms.term[0].gradient_z = as_vector(gradient_[2]);
  add_flow_velocity<ExecSpace>(ExecSpace(), terms, position, velocity);
}

double LinearFlow::typical_rate() const {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += 0.5 * std::pow(gradient_[i][j] + gradient_[j][i], 2);
  return std::sqrt(sum);
}

double LinearFlow::time_scale() const {
  double sum = 0.0;
  for (const auto& row : gradient_) sum += dot(as_vector(row), as_vector(row));
  return sum > 0.0 ? 1.0 / std::sqrt(sum) : std::numeric_limits<double>::infinity();
}

std::string LinearFlow::describe() const {
  const auto row = [](const std::array<double, 3>& g) { return fmt::format("[{:g}, {:g}, {:g}]", g[0], g[1], g[2]); };
  return fmt::format("linear flow u = G (x - ({:g}, {:g}, {:g})), G = [{}, {}, {}]", origin_.x, origin_.y, origin_.z,
                     row(gradient_[0]), row(gradient_[1]), row(gradient_[2]));
}

}  // namespace skein
