#include "rigid_line.hpp"

#include <skein/core/error.hpp>

#include "line_mobility.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

Eigen::MatrixXd invert(const Eigen::MatrixXd& mobility, const Fiber& fiber) {
  const Eigen::LLT<Eigen::MatrixXd> factor(mobility);
  // The square of the ratio of pivots is about the condition number.
  constexpr double least_pivot = 1e-5;
  const auto pivots = factor.matrixLLT().diagonal();
  if (factor.info() != Eigen::Success || !(pivots.minCoeff() > least_pivot * pivots.maxCoeff()))
    throw Error(ExitCode::scene_error,
                fmt::format("fiber {}: blob {:g} is too large for nodes {:g} apart: rounding decides which forces keep "
                            "the fiber rigid; take a smaller blob or fewer nodes",
                            fiber.index, fiber.config.blob, fiber.spacing()));
  return factor.solve(Eigen::MatrixXd::Identity(mobility.rows(), mobility.cols()));
}

std::vector<double> list_entries(const Eigen::MatrixXd& matrix) {
  return std::vector<double>(matrix.data(), matrix.data() + matrix.size());
}

}  // namespace

RigidLine make_rigid_line(const Fiber& fiber, const double viscosity) {
  // In units in which radius and viscosity are 1, so that a scene in other units has the same line to the last bit.
  const double radius = fiber.config.radius, drag_unit = viscosity * radius;
  const int n_nodes = fiber.n_nodes();
  const double spacing = fiber.spacing() / radius;
  const LineMobility mobility = make_line_mobility(n_nodes, spacing, fiber.config.blob / radius);
  const Eigen::MatrixXd along = invert(mobility.along, fiber), across = invert(mobility.across, fiber);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(n_nodes), place = list_line_places(n_nodes, spacing);
  const Eigen::VectorXd slide = along * one, shift = across * one, turn = across * place;
  return {.place = list_entries(radius * place),
          .slide = list_entries(slide / one.dot(slide)),
          .shift = list_entries(shift / one.dot(shift)),
          .turn = list_entries(turn / (radius * place.dot(turn))),
          .across = list_entries(drag_unit * across),
          .along_excess = list_entries(drag_unit * (along - across))};
}

}  // namespace skein
