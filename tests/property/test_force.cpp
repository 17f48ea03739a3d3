// Every kind of force keeps what it promises, on fibers that are bent, squeezed and pressed into each other.
#include <skein/physics/physics.hpp>

#include "tests/reference/force_balance.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"
#include "tests/support/force_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

using Nodes = std::vector<Vec3>;
constexpr double moment_of_test = 0.37;  ///< time

/// Three fibers of different kinds along walks within a small cube, and one force on them.
class ForceTest : public ::testing::TestWithParam<test::ForceRow> {
 protected:
  ForceTest() : physics_(make_physics(make_scene(GetParam()))), random_(17) {
    for (const Fiber& fiber : physics_.fibers) {
      Vec3 point = random_.in_cube(0.002), direction = random_.direction();
      for (int s = 0; s < fiber.config.sections; ++s) {
        const Vec3 across = cross(direction, Vec3{0.36, -0.48, 0.8}), other = cross(direction, across);
        for (int a = 0; a < fiber.config.nodes_per_section; ++a) {
          const double angle = 6.283185307179586 * a / fiber.config.nodes_per_section;
          nodes_.push_back(point + (fiber.config.radius * std::cos(angle) / norm(across)) * across +
                           (fiber.config.radius * std::sin(angle) / norm(other)) * other +
                           random_.in_cube(0.1 * fiber.config.radius));
        }
        direction = direction + 0.4 * random_.direction();
        direction = direction / norm(direction);
        point = point + (fiber.spacing() * random_.uniform(0.6, 1.4)) * direction;
      }
    }
  }

  static SceneConfig make_scene(const test::ForceRow& row) {
    SceneConfig scene;
    scene.fluid.viscosity = 1.7;
    for (const int n : {5, 6, 4}) {
      FiberConfig fiber;
      fiber.sections = 12 + 9 * n;
      fiber.nodes_per_section = n;
      fiber.radius = 0.003 + 0.0004 * n;
      fiber.spring_stiffness = 0.02 * n;
      scene.fibers.push_back(fiber);
    }
    row.configure(scene);
    return scene;
  }

  const Force& force() const { return *physics_.forces.back(); }
  int n_nodes() const { return static_cast<int>(nodes_.size()); }
  Nodes random_vectors() { return reference::make_random_vectors(n_nodes(), 1.0, random_); }

  Nodes forces_at(const Nodes& position, const double time = moment_of_test) const {
    const Vectors sum("force", position.size());
    force().add_forces(time, to_device("position", position), sum);
    return to_host(ConstVectors(sum));
  }

  double energy_at(const Nodes& position, const double time = moment_of_test) const {
    std::vector<double> energy(physics_.fibers.size());
    force().add_energies(time, to_device("position", position), energy);
    double sum = 0.0;
    for (const double part : energy) sum += part;
    return sum;
  }

  double drive_power_at(const Nodes& position, const Nodes& velocity) const {
    std::vector<double> power(physics_.fibers.size());
    force().add_drive_powers(moment_of_test, to_device("position", position), to_device("velocity", velocity), power);
    double sum = 0.0;
    for (const double part : power) sum += part;
    return sum;
  }

  Physics physics_;
  reference::Random random_;
  Nodes nodes_;
};

TEST_P(ForceTest, IsAddedToWhatIsThere) {
  const Nodes alone = forces_at(nodes_);
  EXPECT_GT(reference::norm_of(alone), 0.0);
  const Vectors sum = to_device("force", Nodes(nodes_.size(), Vec3{0.5, -2.0, 4.0}));
  force().add_forces(moment_of_test, to_device("position", nodes_), sum);
  const Nodes both = to_host(ConstVectors(sum));
  for (std::size_t i = 0; i < both.size(); ++i)
    EXPECT_LT(norm(both[i] - alone[i] - Vec3{0.5, -2.0, 4.0}), 1e-13 * (5.0 + norm(alone[i])));
}

TEST_P(ForceTest, HasNoSumAndNoTorqueWhereItPromises) {
  const auto sum = reference::sum_forces(nodes_, forces_at(nodes_), 0, n_nodes());
  const ForcePromises promises = force().promises();
  if (promises.is_balanced)
    EXPECT_LT(norm(sum.net), 1e-13 * sum.size);
  else
    EXPECT_GT(norm(sum.net), 1e-6 * sum.size) << "a promise is missing";
  if (promises.is_torque_free)
    EXPECT_LT(norm(sum.torque), 1e-12 * sum.moment);
  else
    EXPECT_GT(norm(sum.torque), 1e-6 * sum.moment) << "a promise is missing";
}

TEST_P(ForceTest, IsMinusTheGradientOfItsEnergyWhereItPromises) {
  const Nodes f = forces_at(nodes_);
  for (int i = 0; i < 4; ++i) {
    const Nodes v = random_vectors();
    const double h = 1e-7;
    const double slope =
        (energy_at(reference::shifted(nodes_, -h, v)) - energy_at(reference::shifted(nodes_, h, v))) / (2.0 * h);
    const double work = force().promises().is_conservative ? reference::inner_product(f, v) : 0.0;
    EXPECT_NEAR(slope, work, 2e-6 * reference::norm_of(f) * reference::norm_of(v) / std::sqrt(n_nodes()));
  }
}

TEST_P(ForceTest, HasChangesThatAreItsDerivative) {
  const Nodes v = random_vectors();
  const Vectors changed("change", nodes_.size());
  force().add_force_changes(moment_of_test, to_device("x", nodes_), to_device("v", v), changed);
  const Nodes change = to_host(ConstVectors(changed));
  const double h = 1e-8;
  const Nodes difference = reference::shifted(forces_at(reference::shifted(nodes_, h, v)), -1.0,
                                              forces_at(reference::shifted(nodes_, -h, v)));
  // Where nothing changes, rounding of the forces is what the difference shows.
  const double rounding = 1e-16 * reference::norm_of(forces_at(nodes_)) / h;
  EXPECT_LE(reference::norm_of(reference::shifted(change, -0.5 / h, difference)),
            2e-5 * reference::norm_of(change) + 10.0 * rounding);
}

TEST_P(ForceTest, MovesWithARigidBodyWhereItPromises) {
  // A third of a turn about (1, 1, 1): x to y to z to x, without rounding.
  const auto turn = [](const Vec3 v) { return Vec3{v.z, v.x, v.y}; };
  Nodes moved;
  for (const Vec3 x : nodes_) moved.push_back(turn(x) + Vec3{0.31, -0.2, 0.17});
  const Nodes before = forces_at(nodes_), after = forces_at(moved);
  Nodes expected;
  for (const Vec3 f : before) expected.push_back(turn(f));
  const double difference = reference::norm_of(reference::shifted(after, -1.0, expected));
  if (!force().promises().is_frame_indifferent) {
    EXPECT_GT(difference, 1e-6 * reference::norm_of(before)) << "a promise is missing";
    return;
  }
  EXPECT_LT(difference, 1e-11 * reference::norm_of(before));
  EXPECT_NEAR(energy_at(moved), energy_at(nodes_), 1e-11 * std::abs(energy_at(nodes_)));
}

/// What ranks go by: forces on some nodes from positions near them, and from all centroids where they see those.
TEST_P(ForceTest, DependsOnNothingBeyondItsReach) {
  const ForcePromises promises = force().promises();
  ASSERT_NE(promises.reach, ForcePromises::everywhere) << "a promise is missing";
  const Nodes f = forces_at(nodes_), v = random_vectors();
  const Vectors whole = to_device("x", nodes_), displacement = to_device("v", v);
  const Vectors changed("change", nodes_.size());
  force().add_force_changes(moment_of_test, whole, displacement, changed);
  const Nodes change = to_host(ConstVectors(changed));
  SeenNodes seen;
  if (promises.sees_centroids) {
    const Vectors centroid("centroid", static_cast<std::size_t>(physics_.sections.n_sections()));
    const Vectors mean("mean", centroid.extent(0));
    physics_.sections.compute_means(whole, centroid);
    physics_.sections.compute_means(displacement, mean);
    seen.centroid = centroid;
    seen.mean_displacement = mean;
  }
  for (const Fiber& fiber : physics_.fibers) {
    const int n = fiber.config.nodes_per_section;
    for (const int section : {0, 7, 17, fiber.config.sections / 2, fiber.config.sections - 1}) {
      Nodes moved = nodes_, displaced = v;
      for (int node = 0; node < n_nodes(); ++node) {
        const int other = (node - fiber.first_node) / n;
        const bool is_own = node >= fiber.first_node && node < fiber.first_node + fiber.n_nodes();
        if (is_own && std::abs(other - section) <= promises.reach) continue;
        moved[node] = moved[node] + random_.in_cube(0.01);
        displaced[node] = random_.in_cube(1.0);
      }
      seen.position = to_device("moved", moved);
      seen.displacement = {};
      const int first = fiber.first_node + section * n;
      const Vectors force_on("force", nodes_.size()), change_on("change", nodes_.size());
      force().add_forces_on(first, n, moment_of_test, seen, force_on);
      seen.displacement = to_device("displaced", displaced);
      force().add_force_changes_on(first, n, moment_of_test, seen, change_on);
      const Nodes after = to_host(ConstVectors(force_on)), change_after = to_host(ConstVectors(change_on));
      for (int node = first; node < first + n; ++node) {
        EXPECT_EQ(after[node], f[node]) << "section " << section;
        EXPECT_EQ(change_after[node], change[node]) << "section " << section;
      }
    }
  }
}

TEST_P(ForceTest, IsSteadyWhereItPromises) {
  const Nodes now = forces_at(nodes_), later = forces_at(nodes_, moment_of_test + 0.1);
  EXPECT_EQ(now == later, force().promises().is_steady);
  // What changes by itself moves fibers in some time, and limits steps where it oscillates.
  EXPECT_TRUE(force().promises().is_steady || std::isfinite(force().time_scale()));
  EXPECT_GT(force().time_scale(), 0.0);
  TimeCourse course;
  force().add_course(course);
  EXPECT_EQ(course.longest_step(moment_of_test) < 1e3, !force().promises().is_steady);
}

// Where an energy changes with time at fixed positions, that is what drives; where there is none, the force's work is.
TEST_P(ForceTest, IsDrivenByWhatItsEnergyDoesNotExplain) {
  const Nodes u = random_vectors(), f = forces_at(nodes_);
  const double h = 1e-6;
  const double rate = (energy_at(nodes_, moment_of_test + h) - energy_at(nodes_, moment_of_test - h)) / (2.0 * h);
  const double expected = force().promises().is_conservative ? rate : reference::inner_product(f, u);
  EXPECT_NEAR(drive_power_at(nodes_, u), expected,
              1e-7 * reference::norm_of(f) * reference::norm_of(u) + 1e-9 * std::abs(energy_at(nodes_)) / h * 1e-6);
}

TEST_P(ForceTest, HasMomentsThatAddUpToTheFirstMomentOfItsForces) {
  std::vector<SymmetricTensor> moments(physics_.fibers.size());
  force().add_moments(physics_.fibers, moment_of_test, to_device("position", nodes_), moments);
  SymmetricTensor sum{}, expected{};
  const Nodes f = forces_at(nodes_);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Fiber& fiber = physics_.fibers[i];
    Vec3 middle;
    for (int node = fiber.first_node; node < fiber.first_node + fiber.n_nodes(); ++node)
      middle = middle + nodes_[node] / fiber.n_nodes();
    // Arms between fibers add up to those from any origin; else each fiber's are from its centroid.
    if (force().promises().acts_between_fibers) middle = {};
    for (int node = fiber.first_node; node < fiber.first_node + fiber.n_nodes(); ++node) {
      const Vec3 d = nodes_[node] - middle, g = f[node];
      const SymmetricTensor part{d.x * g.x,
                                 d.y * g.y,
                                 d.z * g.z,
                                 0.5 * (d.y * g.z + d.z * g.y),
                                 0.5 * (d.x * g.z + d.z * g.x),
                                 0.5 * (d.x * g.y + d.y * g.x)};
      for (int c = 0; c < 6; ++c) expected[c] += part[c];
    }
    for (int c = 0; c < 6; ++c) sum[c] += moments[i][c];
  }
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(sum[c], expected[c], 1e-13 * reference::norm_of(f)) << c;
}

TEST_P(ForceTest, SaysWhatItIs) {
  EXPECT_FALSE(force().describe().empty());
  EXPECT_EQ(physics_.describe_forces(), physics_.forces.size() == 1 ? "" : force().describe());
}

INSTANTIATE_TEST_SUITE_P(EveryKind, ForceTest, ::testing::ValuesIn(test::force_rows),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace skein
