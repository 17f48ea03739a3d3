#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/fiber_kinds.hpp>
#include <skein/physics/chain.hpp>
#include <skein/physics/rigid_tube.hpp>
#include <skein/scene/fiber_spacing.hpp>

#include "line_mobility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr int n_sections_measured = 320;
constexpr double radii_measured = 120.0;
constexpr double least_spacing = 0.5;  ///< in radii: blobs of nodes that are closer can hardly be told apart

/// Force or torque over the velocity of a straight rigid chain in a fluid of viscosity 1.
struct LineDrag {
  double axial, transverse, turning;
};

/// @param blob, spacing  length
LineDrag measure_line(const int n_nodes, const double spacing, const double blob) {
  const LineMobility mobility = make_line_mobility(n_nodes, spacing, blob);
  const Eigen::VectorXd slide = Eigen::VectorXd::Ones(n_nodes);
  const Eigen::VectorXd turn = list_line_places(n_nodes, spacing);
  const Eigen::LLT<Eigen::MatrixXd> factor(mobility.across);
  return {slide.dot(mobility.along.llt().solve(slide)), slide.dot(factor.solve(slide)), turn.dot(factor.solve(turn))};
}

/// The blob between 0.2 and 5 radii, which are 1, with which a line of nodes is as hard to turn: drag grows with the
/// blob.
double find_blob(const int n_nodes, const double spacing, const double turning) {
  double low = 0.2, high = 5.0;
  const auto turns_too_easily = [&](const double ratio) {
    return measure_line(n_nodes, spacing, ratio).turning < turning;
  };
  if (!turns_too_easily(low) || turns_too_easily(high))
    throw Error(ExitCode::scene_error,
                fmt::format("no blob between {:g} and {:g} radii makes a line of {} nodes as hard to turn as the tube: "
                            "the tube is too short, or its nodes too far apart, for one",
                            low, high, n_nodes));
  constexpr int n_halvings = 40;
  for (int i = 0; i < n_halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (turns_too_easily(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The tube that a chain stands for, its stiffness the same all along.
FiberConfig describe_tube(const FiberConfig& chain) {
  FiberConfig tube = chain;
  tube.model = FiberModel::tube;
  tube.chain_nodes = 0;
  tube.stiffness_profile = FiberConfig{}.stiffness_profile;
  return tube;
}

FiberConfig make_chain(const FiberConfig& fiber, const double viscosity) {
  const BeamStiffness beam = measure_beam_stiffness(make_fibers({describe_tube(fiber)}).front());
  const ChainMatch match = match_chain(fiber, viscosity);
  FiberConfig chain = lay_out_chain(fiber);
  chain.blob = match.blob;
  chain.shear_couple = match.shear_couple;
  chain.end_couple = match.end_couple;
  chain.bending_rigidity = beam.relaxed_bending;
  chain.spring_stiffness = beam.relaxed_axial;
  return chain;
}

}  // namespace

ChainMatch match_chain(const FiberConfig& fiber, const double viscosity) {
  SKEIN_REQUIRE(fiber.stands_for_tube(), "a line that stands for no tube has nothing to match");
  // In units in which radius and viscosity are 1, so that a scene in other units has the same chain to the last bit.
  const double radius = fiber.radius, spacing = lay_out_chain(fiber).spacing / radius;
  if (spacing < least_spacing)
    throw Error(
        ExitCode::scene_error,
        fmt::format("the nodes of the line would lie {:.3g} radii apart, less than {:g}: the tube is too short, or "
                    "chain_nodes too many",
                    spacing, least_spacing));
  FiberConfig unit_tube = describe_tube(fiber);
  unit_tube.radius = 1.0;
  unit_tube.blob /= radius;
  unit_tube.spacing /= radius;
  const double in_radii = std::max(2.0, std::ceil(radii_measured / compute_section_spacing(unit_tube)));
  unit_tube.sections = static_cast<int>(std::min({1.0 * fiber.sections, 1.0 * n_sections_measured, in_radii}));
  const Fiber tube = make_fibers({unit_tube}).front();
  const double length = tube.length();
  const int n_nodes = std::max(3, static_cast<int>(std::round(length / spacing)));
  const RigidTubeDrag drag = measure_rigid_tube(tube, 1.0);

  ChainMatch match;
  const double blob = find_blob(n_nodes, length / n_nodes, drag.turning);
  match.blob = blob * radius;
  // Couples act on the links, of which there is one less than nodes.
  const double linked = length * (n_nodes - 1) / n_nodes;
  const double within = std::min(drag.couple_within, drag.torque_along / linked);
  match.shear_couple = viscosity * radius * radius * within;
  match.end_couple = viscosity * radius * radius * radius * 0.5 * (drag.torque_along - within * linked);
  const LineDrag line = measure_line(n_nodes, length / n_nodes, blob);
  match.transverse = line.transverse / drag.transverse;
  match.axial = line.axial / drag.axial;
  return match;
}

SceneConfig resolve_chains(const SceneConfig& scene) {
  SceneConfig resolved = scene;
  FiberKinds chains([&](const FiberConfig& fiber) { return make_chain(fiber, scene.fluid.viscosity); });
  for (std::size_t i = 0; i < resolved.fibers.size(); ++i) {
    FiberConfig& fiber = resolved.fibers[i];
    if (!fiber.stands_for_tube()) continue;
    try {
      fiber = chains.find(fiber);
    } catch (const Error& error) {
      if (error.code() != ExitCode::scene_error) throw;
      throw Error(ExitCode::scene_error, fmt::format("fiber {}: {}", i, error.what()));
    }
  }
  return resolved;
}

}  // namespace skein
