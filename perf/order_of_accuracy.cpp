// The order of each method on a piece of the L = 0.139 orbit, the fiber turning from along the flow to across it, by
// fixed steps against a reference of RK4 with an error far below 1e-9; and how far all methods under error control are
// from it. The exit status is 1 where an order is off by more than 0.2, or a controlled run by more than 1e-5 L.
// Arguments: nodes=6 (on a section; the paper has 18), start=5.2, end=5.6.

#include <skein/arrays/runtime.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/scene/words.hpp>
#include <skein/solvers/spectral_radius.hpp>

#include "perf/orbit_scene.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace skein::perf {
namespace {

using Positions = std::vector<Vec3>;

/// The fiber, and runs of it from anywhere.
class OrbitPiece {
 public:
  explicit OrbitPiece(const int nodes)
      : scene_(make_orbit_scene({.nodes = nodes})), fibers_(make_fibers(scene_.fibers)) {}

  double length() const { return fibers_.front().length(); }
  Positions straight() const { return make_surface_nodes(fibers_); }

  /// @param step  0: under error control
  Positions run(const TimeMethod method, const double step, const double tolerance, const Positions& from,
                const double start, const double end) {
    scene_.time.method = method;
    scene_.time.step = step;
    scene_.time.tolerance = tolerance;
    scene_.time.max_step = 0.5;
    Physics physics = make_direct_physics(scene_);
    FiberDynamics dynamics(physics);
    const auto integrator = make_integrator(scene_, physics, dynamics);
    State state{start, 0, to_device("position", from)};
    while (state.time < end) integrator->advance(state, end);
    return to_host(ConstVectors(state.position));
  }

  double measure_spectral_radius(const Positions& at) {
    Physics physics = make_direct_physics(scene_);
    FiberDynamics dynamics(physics);
    const Vectors position = to_device("position", at), velocity("velocity", at.size());
    dynamics.compute_velocity(0.0, position, velocity);
    SpectralRadius power_iteration(static_cast<int>(at.size()), 1e-5 * fibers_.front().spacing(), 1);
    return power_iteration.estimate(dynamics, 0.0, position, velocity, 1e-3, 200);
  }

 private:
  SceneConfig scene_;
  std::vector<Fiber> fibers_;
};

struct Method {
  TimeMethod method;
  double order;
  double largest_step;  ///< of the steps tried, each half as large as the one before: time, or over 1 / spectral radius
  bool is_explicit;
};

constexpr Method methods[] = {{TimeMethod::euler, 1.0, 1.2, true},
                              {TimeMethod::bs3, 3.0, 0.8, true},
                              {TimeMethod::rk4, 4.0, 1.6, true},
                              {TimeMethod::rkc2, 2.0, 0.01, false},
                              {TimeMethod::trbdf2, 2.0, 0.01, false}};

int measure(const int nodes, const double start, const double end) {
  constexpr double solver_tolerance = 1e-11;  // of implicit stages at fixed steps
  constexpr double largest_deviation = 0.2, tightest = 1e-6, largest_controlled_error = 1e-5;
  OrbitPiece piece(nodes);
  // What RKC2 leaves in stiff modes dies out before the piece begins: it would count for a higher order.
  const double earlier = start - 0.05;
  const Positions nearly = piece.run(TimeMethod::rkc2, 0.0, 1e-6, piece.straight(), 0.0, earlier);
  const double unit = 1.0 / piece.measure_spectral_radius(nearly);
  const Positions from = piece.run(TimeMethod::rk4, 0.3 * unit, solver_tolerance, nearly, earlier, start);
  const double duration = end - start;
  // Whole numbers of steps: a last one of another size would blur the order.
  const auto fit = [&](const double step) { return duration / std::ceil(duration / step); };
  const Positions exact = piece.run(TimeMethod::rk4, fit(0.1 * unit), solver_tolerance, from, start, end);
  std::printf("%d nodes on a section, t = %g to %g, spectral radius %.4g\n", nodes, start, end, 1.0 / unit);
  std::printf("the reference against half as many steps: %.2g L\n",
              largest_distance(exact, piece.run(TimeMethod::rk4, fit(0.2 * unit), solver_tolerance, from, start, end)) /
                  piece.length());
  bool is_good = true;
  for (const Method& method : methods) {
    const char* const name = word_of(method.method).c_str();
    double coarse_error = 0.0, order = 0.0, coarse_order = 0.0;
    double step = fit(method.largest_step * (method.is_explicit ? unit : 1.0));
    for (int halving = 0; halving < 3; ++halving, step *= 0.5) {
      const Positions found = piece.run(method.method, step, solver_tolerance, from, start, end);
      const double error = largest_distance(found, exact) / piece.length();
      coarse_order = order;
      if (halving > 0) order = std::log2(coarse_error / error);
      std::printf("%-7s step %.4e error %.4e L", name, step, error);
      std::printf(halving > 0 ? " order %.3f\n" : "\n", order);
      coarse_error = error;
    }
    const double limit = 2.0 * order - coarse_order;
    const bool is_right = std::abs(limit - method.order) <= largest_deviation;
    std::printf("%-7s order %.3f in the limit, %s %g\n", name, limit, is_right ? "as it should:" : "NOT", method.order);
    is_good = is_good && is_right;
  }
  for (const Method& method : methods) {
    const char* const name = word_of(method.method).c_str();
    if (method.method == TimeMethod::euler) continue;  // it has no error control
    const double error =
        largest_distance(piece.run(method.method, 0.0, tightest, from, start, end), exact) / piece.length();
    std::printf("%-7s at a tolerance of %g: error %.3e L\n", name, tightest, error);
    is_good = is_good && error < largest_controlled_error;
  }
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace skein::perf

int main(int argc, char** argv) {
  skein::Runtime runtime;
  int nodes = 6;
  double start = 5.2, end = 5.6;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::string value = argument.substr(argument.find('=') + 1);
    if (argument.starts_with("nodes=")) nodes = std::atoi(value.c_str());
    if (argument.starts_with("start=")) start = std::atof(value.c_str());
    if (argument.starts_with("end=")) end = std::atof(value.c_str());
  }
  return skein::perf::measure(nodes, start, end);
}
