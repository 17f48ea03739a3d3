#include "physics/flow_table.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/velocity_gradient.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

template <VelocityGradient (*make_gradient)(double rate)>
FlowTerm make_linear_term(const FlowConfig& flow, const double rate) {
  const VelocityGradient g = make_gradient(rate);
  FlowTerm term;
  term.origin = flow.center;
  term.gradient_x = {g[0][0], g[0][1], g[0][2]};
  term.gradient_y = {g[1][0], g[1][1], g[1][2]};
  term.gradient_z = {g[2][0], g[2][1], g[2][2]};
  return term;
}

template <FlowShape shape>
FlowTerm make_curved_term(const FlowConfig& flow, const double rate) {
  FlowTerm term;
  term.shape = shape;
  term.origin = flow.center;
  term.rate = rate;
  term.size = flow.size;
  return term;
}

/// "x", or "(x - 0.3)" from a center that is not 0.
std::string from_center(const char* name, const double center) {
  if (center == 0.0) return name;
  return fmt::format("({} {} {:g})", name, center > 0.0 ? '-' : '+', std::abs(center));
}

const FlowRow rows[] = {
    {FlowKind::shear, make_linear_term<make_shear_gradient>, 1.0, 1.0, "shear ({r} {y}, 0, 0)"},
    {FlowKind::planar_extension, make_linear_term<make_planar_extension_gradient>, 2.0, 1.0,
     "planar extension {r} (-{x}, {y}, 0)"},
    {FlowKind::uniaxial_extension, make_linear_term<make_uniaxial_extension_gradient>, std::numbers::sqrt3, 1.0,
     "uniaxial extension {r} ({x}, -{y}/2, -{z}/2)"},
    {FlowKind::rotation, make_linear_term<make_rotation_gradient>, 0.0, 1.0, "rotation {r} (-{y}, {x}, 0)"},
    {FlowKind::poiseuille, make_curved_term<FlowShape::parabolic>, 1.0, 1.0,
     "Poiseuille {r} {size:g}/2 (1 - ({y}/{size:g})^2, 0, 0)"},
    {FlowKind::vortices, make_curved_term<FlowShape::cellular>, 2.0, 1.0,
     "vortices {r}/k (sin k{x} cos k{y}, -cos k{x} sin k{y}, 0), k = pi/{size:g}"},
    {FlowKind::none, nullptr, 0.0, 0.0, ""},
};

}  // namespace

const FlowRow& row_of(const FlowKind kind) {
  for (const FlowRow& row : rows)
    if (row.kind == kind) return row;
  throw Error(ExitCode::internal,
              fmt::format("the table of flows has no row for kind {}: add one", static_cast<int>(kind)));
}

std::string FlowRow::describe_velocity(const FlowConfig& flow, const std::string& r) const {
  return fmt::format(fmt::runtime(velocity), fmt::arg("r", r), fmt::arg("size", flow.size),
                     fmt::arg("x", from_center("x", flow.center.x)), fmt::arg("y", from_center("y", flow.center.y)),
                     fmt::arg("z", from_center("z", flow.center.z)));
}

}  // namespace skein
