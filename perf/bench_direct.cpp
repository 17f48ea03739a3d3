// Pairs per second of the direct sum: general and symmetric, by a half and a quarter of the nodes and their images,
// double and single precision, beside a plain OpenMP loop in the same run. Pairs are those of all nodes. Beyond 30 000
// nodes that loop would take minutes, and the general sum in double is what errors are measured by. Usage:
// bench_direct [nodes...]   (threads: OMP_NUM_THREADS)

#include <skein/arrays/runtime.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/physics/node_symmetry.hpp>
#include <skein/physics/symmetric_mobility.hpp>

#include "harness.hpp"
#include "kernels/stokeslet_direct.hpp"
#include "kernels/stokeslet_teams.hpp"
#include "plain_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>

namespace {

using namespace skein;

constexpr double viscosity = 1.7;
constexpr int most_plain_nodes = 30000;

struct Result {
  std::string name;
  double pairs_per_second;
  double error;  ///< 2-norm, of what comes first
};

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(difference / size);
}

std::vector<double> flat(const Vectors& velocity) {
  std::vector<double> result;
  const auto list = to_host(velocity);
  for (int c = 0; c < 3; ++c)
    for (const Vec3& v : list) result.push_back(c == 0 ? v.x : c == 1 ? v.y : v.z);
  return result;
}

/// The general sum: by vector types on a host, by teams on a device.
template <class Space>
void add_general_sum(const Space& space, const Sources& sources, const Vectors& velocity, const Precision precision,
                     [[maybe_unused]] Scalars& partial) {
  const int n = velocity.extent_int(0);
  if constexpr (on_host<Space>)
    add_stokeslet_velocity(space, sources.position, sources.force, sources.blob, sources.position, velocity, viscosity,
                           precision);
  else
    add_stokeslet_velocity_by_teams<Space>(space, sources.position, sources.force, sources.blob, sources.position,
                                           velocity, viscosity, precision, choose_team_split(space.concurrency(), n, n),
                                           partial);
}

/// The host's symmetric sum, in both precisions. A template, so that a GPU build compiles no call of it.
template <class Space>
void add_symmetric_bodies(const Vectors& position, const Vectors& force, const Scalars& blob, const Vectors& velocity,
                          std::vector<std::string>& names, std::vector<std::function<void()>>& bodies) {
  if constexpr (on_host<Space>) {
    const auto symmetric = [=](const Precision precision) {
      add_symmetric_stokeslet_velocity(Space(), position, force, blob, velocity, viscosity, precision);
    };
    names.insert(names.end(), {"symmetric, double", "symmetric, single"});
    bodies.push_back([=] { symmetric(Precision::in_double); });
    bodies.push_back([=] { symmetric(Precision::in_single); });
  }
}

/// Sums over images, in both precisions.
void add_image_bodies(const std::shared_ptr<const NodeSymmetry>& symmetry, const char* share, const Sources& nodes,
                      const Vectors& velocity, std::vector<std::string>& names,
                      std::vector<std::function<void()>>& bodies) {
  for (const Precision precision : {Precision::in_double, Precision::in_single}) {
    names.push_back(std::string(share) + (precision == Precision::in_double ? ", double" : ", single"));
    const auto mobility = std::make_shared<SymmetricMobility>(viscosity, precision, symmetry);
    bodies.push_back([=] { mobility->add_velocity(nodes, nodes.position, velocity); });
  }
}

std::vector<Result> bench(const int sections) {
  FiberConfig config;
  config.sections = sections;
  const auto fibers = make_fibers({config});
  const auto nodes = make_surface_nodes(fibers);
  const int n = static_cast<int>(nodes.size());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vec3> forces(nodes.size());
  for (Vec3& f : forces) f = {uniform(random), uniform(random), uniform(random)};

  const Vectors position = to_device("position", nodes);
  const Vectors force = to_device("force", forces);
  const Scalars blob = to_device("blob", make_blobs(fibers));
  const Vectors velocity("velocity", n);
  const auto make_symmetry = [&](const SymmetryConfig& symmetry) {
    return std::make_shared<const NodeSymmetry>(make_node_orbits(symmetry, fibers, nodes));
  };
  const auto half = make_symmetry({.mirror = SymmetryAxis::z}),
             quarter = make_symmetry({SymmetryAxis::z, SymmetryAxis::z});
  quarter->project(position);
  quarter->project(force);
  Scalars partial;
  const auto general = [&](const Precision precision) {
    add_general_sum<ExecSpace>(ExecSpace(), {position, force, blob}, velocity, precision, partial);
  };

  std::vector<double> x = flat(position), f = flat(force), u(3 * nodes.size());
  std::vector<float> x_float(x.begin(), x.end()), f_float(f.begin(), f.end()), u_float(u.size());
  std::vector<std::string> names;
  std::vector<std::function<void()>> bodies;
  const bool has_plain_loops = n <= most_plain_nodes;
  if (has_plain_loops) {
    names = {"plain loop, double", "plain loop, single"};
    bodies = {[&] { plain_loop(n, x.data(), f.data(), config.blob, viscosity, u.data()); },
              [&] {
                plain_loop(n, x_float.data(), f_float.data(), static_cast<float>(config.blob),
                           static_cast<float>(viscosity), u_float.data());
              }};
  }
  names.insert(names.end(), {"general, double", "general, single"});
  bodies.push_back([&] { general(Precision::in_double); });
  bodies.push_back([&] { general(Precision::in_single); });
  add_symmetric_bodies<ExecSpace>(position, force, blob, velocity, names, bodies);
  add_image_bodies(half, "a half", {position, force, blob}, velocity, names, bodies);
  add_image_bodies(quarter, "a quarter", {position, force, blob}, velocity, names, bodies);
  const int repeats = n < 4000 ? 21 : n < 12000 ? 7 : 3;
  // On a device calls follow each other without a wait, as in a run, until they take long beside one.
  const int n_calls =
      on_host<ExecSpace> ? 1 : static_cast<int>(std::clamp(1e9 / (static_cast<double>(n) * n), 1.0, 50.0));
  std::vector<std::function<void()>> repeated;
  for (const auto& body : bodies)
    repeated.push_back([&body, n_calls] {
      for (int call = 0; call < n_calls; ++call) body();
    });
  const auto seconds = perf::median_seconds(repeats, repeated);
  std::vector<Result> results;
  std::vector<double> exact;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Kokkos::deep_copy(velocity, 0.0);
    bodies[b]();
    const bool is_plain = has_plain_loops && b < 2;
    const std::vector<double> got = !is_plain ? flat(velocity)
                                    : b == 0  ? u
                                              : std::vector<double>(u_float.begin(), u_float.end());
    if (b == 0) exact = got;
    results.push_back({names[b], static_cast<double>(n) * n * n_calls / seconds[b], relative_difference(got, exact)});
  }
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime runtime;
  perf::print_context();
  std::vector<int> sections;
  for (int i = 1; i < argc; ++i) sections.push_back(std::max(2, std::atoi(argv[i]) / 18));
  if (sections.empty()) sections = {80, 113, 301, 536, 1313};
  std::printf("nodes,method,pairs_per_second,times_first_of_same_precision,error\n");
  for (const int n_sections : sections) {
    const auto results = bench(n_sections);
    for (std::size_t r = 0; r < results.size(); ++r)
      std::printf("%d,\"%s\",%.3e,%.2f,%.1e\n", 18 * n_sections, results[r].name.c_str(), results[r].pairs_per_second,
                  results[r].pairs_per_second / results[r % 2].pairs_per_second, results[r].error);
    std::fflush(stdout);
  }
  return 0;
}
