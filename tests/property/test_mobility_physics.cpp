#include "tests/property/mobility_properties.hpp"
#include "tests/reference/gauss_rule.hpp"
#include "tests/reference/point_cloud.hpp"

#include <cmath>
#include <numbers>

// The physics of every Mobility: symmetries, scales, dissipation, volume.

namespace skein {
namespace {

using reference::Cloud;
using reference::PointForces;
using reference::relative_error;

TEST_P(MobilityProperties, IsSymmetric) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(800, true);
    PointForces other = fluid.sources;
    other.force = reference::make_random_vectors(static_cast<int>(other.force.size()), 0.7, fluid.random);
    const auto u = compute(fluid.sources, fluid.viscosity), v = compute(other, fluid.viscosity);
    const double g_m_f = reference::inner_product(other.force, u),
                 f_m_g = reference::inner_product(fluid.sources.force, v);
    RC_ASSERT(std::abs(g_m_f - f_m_g) <=
              tolerance() * (norm_of(other.force) * norm_of(u) + norm_of(fluid.sources.force) * norm_of(v)));
  }));
}

// A force at A moves B as the same force at B moves A, also where A are sources and B targets.
TEST_P(MobilityProperties, IsSymmetricBetweenTwoSetsOfPoints) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(400, true);
    PointForces other = fluid.sources;
    const int n_others = 1 + static_cast<int>(fluid.random.bits() % 300);
    other.position =
        reference::make_cloud(Cloud::tube, n_others, fluid.sources.position.front(), fluid.size, fluid.random);
    other.force = reference::make_random_vectors(n_others, 0.7, fluid.random);
    other.blob.assign(n_others, fluid.sources.blob.front());
    const auto u = compute_at(fluid.sources, other.position, fluid.viscosity);
    const auto v = compute_at(other, fluid.sources.position, fluid.viscosity);
    RC_ASSERT(std::abs(reference::inner_product(other.force, u) - reference::inner_product(fluid.sources.force, v)) <=
              tolerance() * (norm_of(other.force) * norm_of(u) + norm_of(fluid.sources.force) * norm_of(v)));
  }));
}

// Opposite forces on near neighbours dissipate least: forces alternate, and points come in pairs less than a blob
// apart.
TEST_P(MobilityProperties, DissipatesForDistinctPoints) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(400, true);
    PointForces& nodes = fluid.sources;
    const double blob = nodes.blob.front();
    const bool in_pairs = *rc::gen::arbitrary<bool>();
    for (std::size_t i = 1; in_pairs && i < nodes.position.size(); i += 2) {
      nodes.position[i] = nodes.position[i - 1] + 0.5 * blob * fluid.random.direction();
      nodes.force[i] = -nodes.force[i - 1];
    }
    const double power = reference::inner_product(nodes.force, compute(nodes, fluid.viscosity));
    RC_ASSERT(power > 0.0);
  }));
}

// Forces that cancel at each point do nothing at all: zero but for rounding, which may have any sign.
TEST_P(MobilityProperties, NeverGainsEnergyFromCoincidentPoints) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(400, true);
    PointForces& nodes = fluid.sources;
    const bool cancelling = *rc::gen::arbitrary<bool>();
    for (std::size_t i = 1; i < nodes.position.size(); i += 2) {
      nodes.position[i] = nodes.position[i - 1];
      if (cancelling) nodes.force[i] = -nodes.force[i - 1];
    }
    const auto u = compute(nodes, fluid.viscosity);
    const double power = reference::inner_product(nodes.force, u);
    // What the same forces would do without cancelling sets the scale of rounding.
    double scale = 0.0;
    for (const Vec3 f : nodes.force)
      scale += dot(f, f) / (4.0 * std::numbers::pi * fluid.viscosity * nodes.blob.front());
    RC_ASSERT(std::isfinite(power));
    RC_ASSERT(power >= -10.0 * tolerance() * scale);
    if (!cancelling) RC_ASSERT(power > 0.0);
  }));
}

TEST_P(MobilityProperties, TurnsAndMovesWithItsNodes) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(700, *rc::gen::arbitrary<bool>());
    const RigidMotion motion(fluid.random, fluid.size);
    PointForces moved = fluid.sources;
    moved.position = motion.move(moved.position);
    moved.force = motion.turn(moved.force);
    const auto velocity = compute(moved, fluid.viscosity);
    // Moving the nodes rounds their positions: blobs of 1e-3 sizes see that as some 1e-12 of a velocity.
    RC_ASSERT(relative_error(velocity, motion.turn(compute(fluid.sources, fluid.viscosity))) <=
              2.0 * tolerance() + 1e-11);
  }));
}

TEST_P(MobilityProperties, MirrorsWithItsNodes) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(500, true);
    const auto mirrored = [](std::vector<Vec3> list) {
      for (Vec3& v : list) v.y = -v.y;
      return list;
    };
    PointForces image = fluid.sources;
    image.position = mirrored(image.position);
    image.force = mirrored(image.force);
    RC_ASSERT(relative_error(compute(image, fluid.viscosity), mirrored(compute(fluid.sources, fluid.viscosity))) <=
              2.0 * tolerance());
  }));
}

TEST_P(MobilityProperties, IsInverseToTheViscosity) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(500, *rc::gen::arbitrary<bool>());
    const double other = drawn_viscosities[fluid.random.bits() % n_viscosities], factor = other / fluid.viscosity;
    auto thick = compute(fluid.sources, other);
    for (Vec3& u : thick) u = factor * u;
    RC_ASSERT(relative_error(thick, compute(fluid.sources, fluid.viscosity)) <= 2.0 * tolerance());
  }));
}

// Lengths times c, forces alike: velocities over c. Nothing in the fluid has a length of its own but the blob.
TEST_P(MobilityProperties, ScalesWithLength) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(500, *rc::gen::arbitrary<bool>());
    const double factor = fluid.random.log_uniform(0.01, 100.0);
    PointForces large = fluid.sources;
    for (Vec3& x : large.position) x = factor * x;
    for (double& blob : large.blob) blob *= factor;
    auto velocity = compute(large, fluid.viscosity);
    for (Vec3& u : velocity) u = factor * u;
    RC_ASSERT(relative_error(velocity, compute(fluid.sources, fluid.viscosity)) <= 2.0 * tolerance() + 1e-11);
  }));
}

// What flows into a sphere flows out of it, wherever the forces are: inside, outside, and their blobs across its
// surface.
TEST_P(MobilityProperties, IsDivergenceFree) {
  std::vector<double> cosine, weight;
  const int n_polar = 40, n_around = 80;
  reference::make_gauss_rule(n_polar, cosine, weight);
  EXPECT_TRUE(rc::check([&, this] {
    Fluid fluid = draw_fluid(60, false);
    const double radius = fluid.size;
    const Vec3 center = fluid.random.in_cube(5.0 * radius);
    // Not nearer than 0.4 radii to the surface, where 40 rings resolve the flow to 1e-13.
    for (std::size_t i = 0; i < fluid.sources.position.size(); ++i) {
      const bool inside = fluid.random.bits() % 2 == 0;
      const double r = radius * (inside ? fluid.random.uniform(0.0, 0.6) : fluid.random.uniform(1.6, 3.0));
      fluid.sources.position[i] = center + r * fluid.random.direction();
      fluid.sources.blob[i] = radius * fluid.random.log_uniform(0.01, 1.0);
    }
    std::vector<Vec3> normal, target;
    std::vector<double> area;
    for (int i = 0; i < n_polar; ++i)
      for (int j = 0; j < n_around; ++j) {
        const double across = std::sqrt(1.0 - cosine[i] * cosine[i]), angle = 2.0 * std::numbers::pi * j / n_around;
        normal.push_back({across * std::cos(angle), across * std::sin(angle), cosine[i]});
        target.push_back(center + radius * normal.back());
        area.push_back(radius * radius * weight[i] * 2.0 * std::numbers::pi / n_around);
      }
    const auto velocity = compute_at(fluid.sources, target, fluid.viscosity);
    double flux = 0.0, through = 0.0;
    for (std::size_t k = 0; k < target.size(); ++k) {
      flux += area[k] * dot(velocity[k], normal[k]);
      through += area[k] * norm(velocity[k]);
    }
    RC_LOG() << "flux " << flux / through << '\n';
    RC_ASSERT(std::abs(flux) <= (2.0 * tolerance() + 1e-13) * through);
  }));
}

}  // namespace
}  // namespace skein
