// A motion that is turned as a whole, flow, weight, tethers and torques with it, is the same motion: all that an
// analysis says of it stays, or turns along.
#include <skein/physics/linear_flow.hpp>

#include "runs/run_analyzer.hpp"
#include "tests/property/random_fluid.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int n_frames = 40;

/// u = G x of a kind drawn from all that a scene has, and of none of them.
Matrix3 draw_gradient(reference::Random& random) {
  const double rate = random.uniform(0.5, 3.0);
  switch (random.bits() % 8) {
    case 0:
      return {};
    case 1:
      return make_planar_extension_gradient(rate);
    case 2:
      return make_uniaxial_extension_gradient(rate);
    case 3:
      return make_rotation_gradient(rate);
    case 4:
      return make_shear_gradient(-rate);
    case 5: {
      Matrix3 gradient{};
      for (auto& row : gradient)
        for (double& entry : row) entry = random.uniform(-2.0, 2.0);
      gradient[2][2] = -gradient[0][0] - gradient[1][1];
      return gradient;
    }
    default:
      return make_shear_gradient(rate);
  }
}

Matrix3 turn(const RigidMotion& motion, const Matrix3& tensor) {
  const Vec3 axis[3] = {motion.turn(Vec3{1, 0, 0}), motion.turn(Vec3{0, 1, 0}), motion.turn(Vec3{0, 0, 1})};
  const auto entry = [&](const int i, const int a) { return i == 0 ? axis[a].x : i == 1 ? axis[a].y : axis[a].z; };
  Matrix3 turned{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) turned[i][j] += entry(i, a) * entry(j, b) * tensor[a][b];
  return turned;
}

/// A scene, its flow, and nodes that move: bends of several half waves that grow, in a plane or out of it, on a fiber
/// that turns about.
struct MovingScene {
  SceneConfig scene;
  Matrix3 gradient{};
  std::vector<double> time;
  std::vector<std::vector<Vec3>> position;  ///< [n_frames][n_nodes]

  MovingScene turned(const RigidMotion& motion) const {
    MovingScene other = *this;
    other.gradient = turn(motion, gradient);
    for (auto& nodes : other.position) nodes = motion.turn(nodes);
    other.scene.gravity.direction = motion.turn(scene.gravity.direction);
    for (TetherConfig& tether : other.scene.tethers)
      for (Vec3* v : {&tether.point, &tether.velocity, &tether.swing}) *v = motion.turn(*v);
    for (TorqueConfig& torque : other.scene.torques)
      for (Vec3* v : {&torque.torque, &torque.angular_velocity}) *v = motion.turn(*v);
    return other;
  }
};

void add_forces(SceneConfig& scene, reference::Random& random) {
  if (random.bits() % 2 == 0) scene.repulsion.strength = 1.0;
  if (random.bits() % 2 == 0) {
    scene.gravity.weight = 0.3;
    scene.gravity.direction = random.direction();
  }
  if (random.bits() % 2 == 0)
    scene.tethers.push_back({0, -1, 1.5, random.in_cube(0.1), random.in_cube(0.1), random.in_cube(0.02), 2.0});
  if (random.bits() % 2 == 0) scene.torques.push_back({0, 3, random.in_cube(1e-4), random.in_cube(3.0)});
}

/// Sections of one fiber at one moment: tangents of given angles in the plane of `u` and `v`, and out of it.
void add_nodes(const Fiber& fiber, const std::vector<double>& inside, const std::vector<double>& outside,
               const Vec3 center, const Vec3 u, const Vec3 v, std::vector<Vec3>& nodes) {
  const Vec3 w = cross(u, v);
  Vec3 point = center;
  for (int s = 0; s < fiber.config.sections; ++s) {
    if (fiber.config.is_line()) nodes.push_back(point);
    const Vec3 along =
        std::cos(outside[s]) * (std::cos(inside[s]) * u + std::sin(inside[s]) * v) + std::sin(outside[s]) * w;
    Vec3 across = cross(along, std::abs(dot(along, w)) < 0.7 ? w : v);
    across = across / norm(across);
    for (int a = 0; a < fiber.config.nodes_per_section && !fiber.config.is_line(); ++a) {
      const double angle = 2.0 * pi * a / fiber.config.nodes_per_section;
      nodes.push_back(point +
                      fiber.config.radius * (std::cos(angle) * across + std::sin(angle) * cross(along, across)));
    }
    point = point + fiber.spacing() * along;
  }
}

MovingScene draw_scene(reference::Random& random) {
  MovingScene moving;
  moving.gradient = draw_gradient(random);
  moving.scene.fibers.resize(1 + random.bits() % 2);
  for (FiberConfig& fiber : moving.scene.fibers) {
    fiber.sections = 24 + static_cast<int>(random.bits() % 30);
    fiber.nodes_per_section = 4 + static_cast<int>(random.bits() % 3);
    fiber.blob = 0.004;
  }
  // Some of the second fibers are rigid, some chains; without the couple of a shear, which is of a scene's flow.
  if (moving.scene.fibers.size() == 2 && moving.scene.fibers[1].sections % 3 > 0) {
    FiberConfig& line = moving.scene.fibers[1];
    line.model = line.sections % 3 == 1 ? FiberModel::chain : FiberModel::rigid;
    line.nodes_per_section = 1;
    line.spacing = line.blob = 0.007;
  }
  add_forces(moving.scene, random);
  moving.position.resize(n_frames);
  for (int i = 0; i < n_frames; ++i) moving.time.push_back(0.05 * i);
  double place = 0.0;
  for (const Fiber& fiber : make_fibers(moving.scene.fibers)) {
    constexpr double strengths[] = {0.0, 0.02, 0.7, 2.0, 5.0};
    const double drawn = strengths[random.bits() % 5], strength = fiber.config.is_rigid() ? 0.0 : drawn,
                 lift = random.bits() % 2 == 0 ? 0.0 : random.uniform(0.0, 1.0);
    double height[4], phase[4];
    for (int k = 0; k < 4; ++k) {
      height[k] = random.uniform(-1.0, 1.0);
      phase[k] = random.uniform(0.0, 2.0 * pi);
    }
    const Vec3 axis = random.direction(), center{0.0, place, 0.0};
    place += 0.3;
    Vec3 u = random.direction(), v = cross(u, axis);
    v = v / norm(v);
    const double speed = random.uniform(-2.0, 2.0), growth = random.uniform(0.5, 3.0);
    for (int i = 0; i < n_frames; ++i) {
      const double t = moving.time[i], size = strength * std::exp(growth * (t - moving.time.back()));
      std::vector<double> inside(fiber.config.sections, 0.0), outside(fiber.config.sections, 0.0);
      for (int s = 0; s < fiber.config.sections; ++s)
        for (int k = 0; k < 4; ++k) {
          const double wave = std::cos((k + 1) * pi * s / fiber.config.sections + phase[k] - 0.6 * t);
          inside[s] += size * height[k] * wave;
          outside[s] += lift * size * height[3 - k] * wave;
        }
      RigidMotion spin(random, 1.0);
      spin.axis = axis;
      spin.angle = speed * t;
      add_nodes(fiber, inside, outside, center, spin.turn(u), spin.turn(v), moving.position[i]);
    }
  }
  return moving;
}

RunAnalysis analyze(const MovingScene& moving) {
  Physics physics = make_physics(moving.scene);
  physics.flow = std::make_unique<LinearFlow>(moving.gradient, Vec3{});
  RunAnalyzer analyzer(
      moving.scene, physics, [&](Vec3) { return moving.gradient; }, /*with_forces=*/true);
  for (int i = 0; i < n_frames; ++i)
    analyzer.add({i,
                  moving.time[i],
                  moving.position[i],
                  physics.sections.compute_centreline(to_device("position", moving.position[i])),
                  {}});
  return analyzer.take();
}

void expect_close(const double a, const double b, const std::string& what) {
  if (a == b) return;  // infinite ones
  if (std::isnan(a) || std::isnan(b)) {
    EXPECT_EQ(std::isnan(a), std::isnan(b)) << what;
  } else {
    // Rounding of nodes half a length from the origin, over the spacing of sections, in 180 / pi degrees.
    const double rounding = what.find("degree") != std::string::npos ? 1e-9 : 1e-10;
    EXPECT_LE(std::abs(a - b), 1e-6 * std::abs(a) + rounding) << what << ": " << a << ", turned " << b;
  }
}

void expect_close(const Vec3 a, const Vec3 b, const std::string& what) {
  EXPECT_LE(norm(a - b), 1e-6 * norm(a) + 1e-11) << what;
}

/// Texts whose numbers agree, and all else between them to the letter.
void expect_close_texts(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  const auto starts_number = [](const std::string& text, const std::size_t k) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(text[k])) != 0;
    const bool is_signed =
        text[k] == '-' && k + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[k + 1])) != 0;
    return is_digit || is_signed;
  };
  while (i < a.size() && j < b.size()) {
    if (starts_number(a, i) && starts_number(b, j)) {
      std::size_t n_a = 0, n_b = 0;
      const double x = std::stod(a.substr(i, 40), &n_a), y = std::stod(b.substr(j, 40), &n_b);
      expect_close(x, y, a.substr(i < 40 ? 0 : i - 40, 80));
      i += n_a;
      j += n_b;
    } else {
      ASSERT_EQ(a[i], b[j]) << a.substr(i < 60 ? 0 : i - 60, 120) << "\n" << b.substr(j < 60 ? 0 : j - 60, 120);
      ++i;
      ++j;
    }
  }
  EXPECT_EQ(i == a.size(), j == b.size());
}

/// True for columns of what turns with a scene: the particle stress, which is a tensor, and vectors.
bool turns(const std::string& column) {
  for (const char* name : {"stresslet_", "middle_", "force_", "torque_"})
    if (column.rfind(name, 0) == 0) return true;
  return false;
}

/// The rows of a table by its columns, without those that turn.
void expect_close_tables(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::ifstream first(a), second(b);
  std::string line, other, name, value, same;
  std::vector<std::string> names;
  std::getline(first, line);
  std::getline(second, other);
  ASSERT_EQ(line, other);
  for (std::istringstream header(line); std::getline(header, name, ',');) names.push_back(name);
  int n_rows = 0;
  while (std::getline(first, line) && std::getline(second, other)) {
    std::istringstream fields(line), others(other);
    for (const std::string& column : names) {
      std::getline(fields, value, ',');
      std::getline(others, same, ',');
      if (turns(column) || (value.empty() && same.empty())) continue;
      expect_close(std::stod(value), std::stod(same), column + " of row " + std::to_string(n_rows));
    }
    ++n_rows;
  }
  EXPECT_GT(n_rows, 0);
}

void expect_turned(const RunAnalysis& a, const RunAnalysis& b, const RigidMotion& motion) {
  for (std::size_t f = 0; f < a.histories.size(); ++f) {
    const FiberHistory &one = a.histories[f], &other = b.histories[f];
    EXPECT_EQ(one.regimes(), other.regimes());
    EXPECT_EQ(one.flow().angle_origin, other.flow().angle_origin);
    for (std::size_t i = 0; i < one.curvature().size(); ++i) {
      expect_close(one.curvature()[i], other.curvature()[i], "curvature");
      expect_close(one.arclength()[i], other.arclength()[i], "arclength");
    }
    const FiberSummary first = one.summarize(), second = other.summarize();
    ASSERT_EQ(first.tracks.size(), second.tracks.size());
    for (std::size_t t = 0; t < first.tracks.size(); ++t)
      for (std::size_t i = 0; i < first.tracks[t].time.size(); ++i) {
        expect_close(first.tracks[t].arclength[i], second.tracks[t].arclength[i], "track");
        expect_close(first.tracks[t].curvature[i], second.tracks[t].curvature[i], "track's curvature");
      }
    for (const FiberEnd end : {FiberEnd::first, FiberEnd::last})
      for (std::size_t i = 0; i < one.hooks(end).size(); ++i) {
        ASSERT_EQ(one.hooks(end)[i].has_value(), other.hooks(end)[i].has_value());
        if (!one.hooks(end)[i]) continue;
        expect_close(motion.turn(one.hooks(end)[i]->circle.center), other.hooks(end)[i]->circle.center, "hook");
        expect_close(one.hooks(end)[i]->bend.turning, other.hooks(end)[i]->bend.turning, "hook's turning");
      }
    for (std::size_t i = 0; i < a.forces[f].size(); ++i) {
      const Matrix3 expected = turn(motion, a.forces[f][i].stresslet), found = b.forces[f][i].stresslet;
      double size = 0.0, difference = 0.0;
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) {
          size += expected[p][q] * expected[p][q];
          difference += std::pow(expected[p][q] - found[p][q], 2);
        }
      EXPECT_LE(difference, 1e-14 * size + 1e-30) << "particle stress";
      for (const auto vector : {&ForceRecord::middle, &ForceRecord::force, &ForceRecord::torque}) {
        const Vec3 turned = motion.turn(a.forces[f][i].*vector), other_vector = b.forces[f][i].*vector;
        const double scale = vector == &ForceRecord::middle ? 1.0 : std::sqrt(size) / 0.1;
        EXPECT_LE(norm(turned - other_vector), 1e-7 * (norm(turned) + scale) + 1e-16) << "vectors of the forces";
      }
    }
  }
}

/// How often each kind of what an analysis can say was met.
struct Coverage {
  int regimes[6] = {}, origins[4] = {}, n_hooks = 0, n_tracks = 0, n_half_periods = 0;

  void count(const RunAnalysis& analysis) {
    for (const FiberHistory& history : analysis.histories) {
      const FiberSummary summary = history.summarize();
      ++regimes[static_cast<int>(summary.regime)];
      ++origins[static_cast<int>(history.flow().angle_origin)];
      n_tracks += static_cast<int>(summary.tracks.size());
      n_half_periods += static_cast<int>(summary.half_periods.size());
      for (const auto& hook : history.hooks(FiberEnd::first)) n_hooks += hook.has_value();
    }
  }
};

TEST(Rotation, ChangesNothingThatAnAnalysisSays) {
  constexpr int n_scenes = 50;
  const ScratchFolder folder;
  Coverage coverage;
  for (int i = 0; i < n_scenes; ++i) {
    SCOPED_TRACE(i);
    reference::Random random(100 + i);
    const MovingScene moving = draw_scene(random);
    const RigidMotion motion(random, 1.0);
    const RunAnalysis as_drawn = analyze(moving), turned = analyze(moving.turned(motion));
    coverage.count(as_drawn);
    expect_close_texts(describe_analysis_as_json(as_drawn), describe_analysis_as_json(turned));
    write_analysis(as_drawn, folder.path() / "drawn");
    write_analysis(turned, folder.path() / "turned");
    expect_close_tables(folder.path() / "drawn" / "diagnostics.csv", folder.path() / "turned" / "diagnostics.csv");
    expect_turned(as_drawn, turned, motion);
    if (HasFailure()) return;
  }
  for (const int n : coverage.regimes) EXPECT_GT(n, 0);
  for (const int n : coverage.origins) EXPECT_GT(n, 0);
  EXPECT_GT(coverage.n_hooks, 50);
  EXPECT_GT(coverage.n_tracks, 20);
  EXPECT_GT(coverage.n_half_periods, 0);
}

}  // namespace
}  // namespace skein
