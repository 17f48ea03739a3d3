// What implicit steps of fibers are made of: banded factors, GMRES, the fibers' linearization.

#include <skein/core/error.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/spring_forces.hpp>
#include <skein/solvers/block_band.hpp>
#include <skein/solvers/gmres.hpp>
#include <skein/solvers/method_selection.hpp>

#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"
#include "tests/support/direct_physics.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

std::vector<FiberConfig> make_configs() {
  FiberConfig one, two;
  one.sections = 12, one.nodes_per_section = 6, one.blob = 0.003, one.direction = {0.3, -1.0, 0.8};
  one.stiffness_profile = {{0.0, 1.0}, {0.4, 3.0}, {1.0, 0.5}};
  two.sections = 3, two.nodes_per_section = 9, two.blob = 0.002, two.spring_stiffness = 0.023,
  two.center = {0.0, 0.05, 0.0};
  return {one, two};
}

struct Bent {
  std::vector<Fiber> fibers = make_fibers(make_configs());
  std::vector<Vec3> position = make_surface_nodes(fibers);
  Bent() {
    reference::Random random(3);
    for (Vec3& x : position) x = x + Vec3{0.0, 3.0 * x.x * x.x, 2.0 * x.x * x.y} + random.in_cube(1e-4);
  }
};

std::vector<Vec3> forces_of(const SpringForces& springs, const std::vector<Vec3>& position) {
  const Vectors force("force", position.size());
  springs.add_forces(0.0, to_device("position", position), force);
  return to_host(ConstVectors(force));
}

TEST(BlockBand, SolvesLikeADenseMatrix) {
  reference::Random random(7);
  for (const int half_width : {0, 1, 3, 20}) {
    const int n_sections = 9, size = 7, n = n_sections * size;
    BlockBand band(n_sections, size, half_width);
    band.set_to_zero();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column) {
        const int s = row / size, t = column / size;
        if (std::abs(s - t) > half_width) continue;
        dense(row, column) = random.uniform(-1.0, 1.0) + (row == column ? 25.0 : 0.0);
        band.block(s, t)[row % size + size * (column % size)] = dense(row, column);
      }
    Eigen::VectorXd right(n);
    for (int row = 0; row < n; ++row) right(row) = random.uniform(-2.0, 2.0);
    Eigen::VectorXd x = right;
    ASSERT_TRUE(band.factorize());
    band.solve(x.data());
    // Factors are rounded to single precision: 6e-8 each.
    EXPECT_LT((dense * x - right).norm(), 1e-6 * right.norm()) << half_width;
  }
  BlockBand singular(3, 2, 1);
  singular.set_to_zero();
  EXPECT_FALSE(singular.factorize());
}

/// A dense matrix, preconditioned by nothing.
class DenseLinearization final : public Linearization {
 public:
  explicit DenseLinearization(Eigen::MatrixXd matrix) : matrix_(std::move(matrix)) {}
  void set_position(double, const ConstVectors&) override {}
  void multiply(const ConstVectors& v, const Vectors& result) override {
    const std::vector<Vec3> list = to_host(v);
    Eigen::VectorXd x(3 * list.size());
    for (std::size_t i = 0; i < list.size(); ++i) x.segment<3>(3 * i) << list[i].x, list[i].y, list[i].z;
    const Eigen::VectorXd y = matrix_ * x;
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < list.size(); ++i) out.push_back({y(3 * i), y(3 * i + 1), y(3 * i + 2)});
    Kokkos::deep_copy(result, to_device("y", out));
  }
  bool factorize(const ConstVectors&, double) override { return true; }
  PreconditionerCost preconditioner_cost() const override { return {}; }
  void precondition(const ConstVectors& v, const Vectors& result) override { Kokkos::deep_copy(result, v); }
  std::string describe() const override { return "none"; }

 private:
  Eigen::MatrixXd matrix_;
};

TEST(Gmres, SolvesAndStopsHonestly) {
  const int n = 7;
  reference::Random random(9);
  Eigen::MatrixXd matrix(3 * n, 3 * n);
  for (int i = 0; i < 3 * n; ++i)
    for (int j = 0; j < 3 * n; ++j) matrix(i, j) = random.uniform(-1.0, 1.0);
  DenseLinearization a(matrix);
  const auto list = reference::make_random_vectors(n, 1.0, random);
  const Vectors b = to_device("b", list);
  Eigen::VectorXd right(3 * n);
  for (int i = 0; i < n; ++i) right.segment<3>(3 * i) << list[i].x, list[i].y, list[i].z;
  const double scale = 0.37;
  const Eigen::VectorXd exact = (Eigen::MatrixXd::Identity(3 * n, 3 * n) - scale * matrix).partialPivLu().solve(right);
  for (const bool guess : {false, true}) {
    const Vectors x("x", n);
    if (guess) Kokkos::deep_copy(x, 0.3);
    const auto result = Gmres(n, 40).solve(a, scale, b, x, 1e-12);
    EXPECT_TRUE(result.converged);
    EXPECT_LE(result.iterations, 3 * n + 1 + guess);
    const auto found = to_host(ConstVectors(x));
    for (int i = 0; i < n; ++i) EXPECT_NEAR(found[i].y, exact(3 * i + 1), 1e-9);
  }
  const Vectors x("x", n);
  const auto stopped = Gmres(n, 5).solve(a, scale, b, x, 1e-12);
  EXPECT_FALSE(stopped.converged);
  EXPECT_EQ(stopped.iterations, 5);
  EXPECT_GT(stopped.residual, 1e-12);
  a = DenseLinearization(matrix * std::nan(""));
  EXPECT_FALSE(std::isfinite(Gmres(n, 5).solve(a, scale, b, b, 1e-12).residual));
}

struct LinearizedFibers {
  Bent bent;
  Physics physics;
  FiberDynamics dynamics;
  LinearizedFibers() : physics(test::make_direct_physics(make_scene())), dynamics(physics) {}

 private:
  static SceneConfig make_scene() {
    SceneConfig scene;
    scene.fluid.viscosity = 1.7;
    scene.fibers = make_configs();
    return scene;
  }
};

TEST(FiberLinearization, MultipliesByMobilityAndTangent) {
  LinearizedFibers linearized;
  const auto& position = linearized.bent.position;
  reference::Random random(11);
  const auto v = reference::make_random_vectors(static_cast<int>(position.size()), 1.0, random);
  Linearization& a = *linearized.dynamics.linearization();
  const Vectors x = to_device("x", position), product("product", position.size());
  a.set_position(0.0, x);
  const auto before = linearized.dynamics.evaluations();
  a.multiply(to_device("v", v), product);
  EXPECT_EQ(linearized.dynamics.evaluations(), before + 1);

  // M (F(x + h v) - F(x - h v)) / (2 h), with M from another object.
  const SpringForces springs(linearized.bent.fibers);
  const double h = 1e-7;
  auto force = reference::shifted(forces_of(springs, reference::shifted(position, h, v)), -1.0,
                                  forces_of(springs, reference::shifted(position, -h, v)));
  for (Vec3& f : force) f = (0.5 / h) * f;
  const Vectors expected("expected", position.size());
  DirectMobility mobility(1.7, Precision::in_double);
  mobility.add_velocity({x, to_device("f", force), to_device("blob", make_blobs(linearized.bent.fibers))}, x, expected);
  const auto wanted = to_host(ConstVectors(expected));
  EXPECT_LT(reference::norm_of(reference::shifted(to_host(ConstVectors(product)), -1.0, wanted)),
            1e-6 * reference::norm_of(wanted));
}

TEST(FiberLinearization, PreconditionsWellAndTurnsWithTheFibers) {
  LinearizedFibers linearized;
  const auto& position = linearized.bent.position;
  const int n = static_cast<int>(position.size());
  reference::Random random(13);
  const auto list = reference::make_random_vectors(n, 1.0, random);
  Linearization& a = *linearized.dynamics.linearization();
  const double scale = 0.02;  // 200 times the decay time of the fastest mode
  a.set_position(0.0, to_device("x", position));
  ASSERT_TRUE(a.factorize(to_device("x", position), scale));
  const Vectors x("x", n);
  const auto solved = Gmres(n, 60).solve(a, scale, to_device("b", list), x, 1e-6);
  EXPECT_TRUE(solved.converged);
  EXPECT_LE(solved.iterations, 25);

  // Half a turn about an oblique axis (diagonal of the xy plane): x and y change places, z its sign.
  const auto turn = [](const std::vector<Vec3>& v) {
    std::vector<Vec3> turned;
    for (const Vec3 u : v) turned.push_back({u.y, u.x, -u.z});
    return turned;
  };
  const Vectors result("result", n);
  a.precondition(to_device("b", list), result);
  const auto expected = turn(to_host(ConstVectors(result)));
  a.set_position(0.0, to_device("x", turn(position)));
  a.precondition(to_device("b", turn(list)), result);
  EXPECT_LT(reference::norm_of(reference::shifted(to_host(ConstVectors(result)), -1.0, expected)),
            1e-10 * reference::norm_of(expected));
}

ControlOptions make_options(const double tolerance) {
  ControlOptions options;
  options.tolerance = tolerance;
  options.time_scale = 0.4;
  options.max_step = 0.5;
  return options;
}

TEST(MethodSelection, FollowsTheStiffness) {
  const ControlOptions options = make_options(1e-3);
  EXPECT_EQ(select_method(options, 1e2, {60.0, 0.5}).method, TimeMethod::rkc2);
  EXPECT_EQ(select_method(options, 1e6, {60.0, 0.5}).method, TimeMethod::trbdf2);
  // What the matrix takes is weighed, and how much more often a poorer one is used.
  EXPECT_EQ(select_method(options, 1e4, {60.0, 0.5}).method, TimeMethod::trbdf2);
  EXPECT_EQ(select_method(options, 1e4, {60.0, 4.0}).method, TimeMethod::rkc2);
  EXPECT_EQ(select_method(options, 1e4, {60.0, 0.5, 4.0}).method, TimeMethod::rkc2);
  EXPECT_EQ(select_explicit_method(options, 1e6, "nothing else is there").method, TimeMethod::rkc2);
  EXPECT_NE(select_method(options, 1e6, {60.0, 0.5}).reason.find("1e+06"), std::string::npos);
}

// Where the other method was measured to take more than 1.5 times the processor time.
TEST(MethodSelection, AgreesWithWhatWasMeasured) {
  struct Row {
    double length, spacing, spectral_radius, tolerance;
    double factorization, preconditioning;  // in evaluations
    TimeMethod method;
  };
  const double s6 = 0.005, s18 = 0.00173648;
  const Row rows[] = {{0.14, s6, 1509.0, 1e-4, 59.0, 2.1, TimeMethod::rkc2},
                      {0.14, s6, 1509.0, 1e-6, 59.0, 2.1, TimeMethod::rkc2},
                      {0.195, s6, 1509.0, 1e-2, 43.0, 1.5, TimeMethod::rkc2},
                      {0.195, s6, 1509.0, 1e-6, 43.0, 1.5, TimeMethod::rkc2},
                      {0.14, s6, 1.5e5, 1e-2, 59.0, 2.1, TimeMethod::trbdf2},
                      {0.14, s6, 1.5e5, 1e-6, 59.0, 2.1, TimeMethod::trbdf2},
                      {0.139, s18, 10935.0, 1e-2, 62.0, 0.73, TimeMethod::rkc2},
                      {0.139, s18, 1.1e5, 1e-3, 62.0, 0.73, TimeMethod::trbdf2},
                      {0.139, s18, 1.1e5, 1e-5, 62.0, 0.73, TimeMethod::trbdf2},
                      {0.139, s18, 1.1e6, 1e-2, 62.0, 0.73, TimeMethod::trbdf2},
                      {0.139, s18, 1.1e6, 1e-5, 62.0, 0.73, TimeMethod::trbdf2}};
  for (const Row& row : rows) {
    ControlOptions options = make_options(row.tolerance);
    options.length_scale = row.length;
    options.detail_scale = row.spacing;
    const auto selection = select_method(options, row.spectral_radius, {row.factorization, row.preconditioning});
    EXPECT_EQ(selection.method, row.method) << row.length << ", " << row.tolerance << ": " << selection.reason;
  }
}

}  // namespace
}  // namespace skein
