// Waves of preferred curvature: what a fiber looks like that has what it prefers, and how it swims.
#include <skein/physics/physics.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double to_radians = std::numbers::pi / 180.0;

/// Along x, with node 0 of each section towards y.
SceneConfig make_scene(const int nodes_per_section) {
  SceneConfig scene;
  scene.flows = {{.kind = FlowKind::none}};
  FiberConfig fiber;
  fiber.sections = 16;
  fiber.nodes_per_section = nodes_per_section;
  fiber.radius = 0.005;
  fiber.spacing = 0.004;
  scene.fibers = {fiber};
  return scene;
}

/// Nodes of the fiber bent to an arc of a curvature towards the side at an angle from node 0.
std::vector<Vec3> bend(const SceneConfig& scene, const double curvature, const double side) {
  const FiberConfig& fiber = scene.fibers[0];
  const Vec3 inwards{0.0, std::cos(side), std::sin(side)}, about{0.0, -std::sin(side), std::cos(side)};
  std::vector<Vec3> nodes;
  for (int s = 0; s < fiber.sections; ++s) {
    const double angle = curvature * fiber.spacing * (s - 0.5 * (fiber.sections - 1));
    for (int a = 0; a < fiber.nodes_per_section; ++a) {
      const double place = 2.0 * std::numbers::pi * a / fiber.nodes_per_section - side;
      const double towards = fiber.radius * std::cos(place), along_axis = fiber.radius * std::sin(place);
      const double arm = 1.0 / curvature - towards;
      nodes.push_back(Vec3{arm * std::sin(angle), 0.0, 0.0} + (1.0 / curvature - arm * std::cos(angle)) * inwards +
                      along_axis * about);
    }
  }
  return nodes;
}

double largest_force(const Physics& physics, const std::vector<Vec3>& nodes, const double time = 0.0) {
  const Vectors force("force", nodes.size());
  physics.compute_forces(time, to_device("position", nodes), force);
  double largest = 0.0;
  for (const Vec3 f : to_host(ConstVectors(force))) largest = std::max(largest, norm(f));
  return largest;
}

// With rest lengths that are those of an arc to first order, forces are of second order in curvature times radius, and
// those of the straight fiber of first order.
TEST(Undulation, AFiberAtItsPreferredCurvatureIsAtRest) {
  for (const int nodes_per_section : {4, 5, 12})
    for (const double plane : {0.0, 90.0, -137.0})
      for (const double curvature : {10.0, -10.0, 2.5}) {
        SceneConfig scene = make_scene(nodes_per_section);
        scene.fibers[0].reach_along = nodes_per_section == 5 ? 2 : 1;
        scene.undulations = {{.curvature = curvature, .plane = plane}};
        const Physics physics = make_physics(scene);
        const double straight = largest_force(physics, physics.make_start_nodes(1));
        const double arc = largest_force(physics, bend(scene, curvature, plane * to_radians));
        const double other_arc = largest_force(physics, bend(scene, -curvature, plane * to_radians));
        EXPECT_LT(arc, 2.0 * std::abs(curvature) * scene.fibers[0].radius * straight)
            << nodes_per_section << ' ' << plane;
        EXPECT_GT(other_arc, 1.8 * straight);
      }
}

TEST(Undulation, WavesTravelRiseAndAddUp) {
  SceneConfig scene = make_scene(6);
  // At a quarter of the period and a quarter of the wavelength on, the wave is what it was at the start.
  const double period = 2.0, wavelength = 0.064;
  const UndulationConfig wave{
      .curvature = 10.0, .wavelength = wavelength, .angular_frequency = 2.0 * std::numbers::pi / period, .phase = 30.0};
  scene.undulations = {wave};
  const Physics travels = make_physics(scene);
  scene.undulations[0].phase -= 90.0;
  const Physics later = make_physics(scene);
  const auto nodes = travels.make_start_nodes(1);
  EXPECT_NEAR(largest_force(travels, nodes, 0.25 * period), largest_force(later, nodes, 0.0), 1e-12);

  scene.undulations = {wave, wave};
  scene.undulations[0].curvature = 4.0;
  scene.undulations[1].curvature = 6.0;
  EXPECT_NEAR(largest_force(make_physics(scene), nodes, 0.3), largest_force(travels, nodes, 0.3), 1e-12);

  scene.undulations = {wave};
  scene.undulations[0].ramp = 5.0;
  const Physics rises = make_physics(scene);
  EXPECT_LT(largest_force(rises, nodes, 0.0), 1e-15);
  EXPECT_EQ(largest_force(rises, nodes, 5.0), largest_force(travels, nodes, 5.0));
  EXPECT_NEAR(largest_force(rises, nodes, 2.5), 0.5 * largest_force(travels, nodes, 2.5),
              0.05 * largest_force(travels, nodes, 2.5));
}

TEST(Undulation, StepsSeeItsPeriodAndItsRise) {
  SceneConfig scene = make_scene(6);
  scene.undulations = {{.curvature = 10.0, .wavelength = 0.06, .angular_frequency = -4.0, .ramp = 0.7}};
  const Physics physics = make_physics(scene);
  const double period = 2.0 * std::numbers::pi / 4.0;
  EXPECT_DOUBLE_EQ(physics.time_scale(), period);
  const TimeCourse course = physics.make_time_course();
  EXPECT_LE(course.longest_step(1.0), period / 16.0);
  EXPECT_DOUBLE_EQ(course.next_break(0.1), 0.7);
  EXPECT_FALSE(physics.forces.back()->promises().is_steady);
}

}  // namespace
}  // namespace skein
