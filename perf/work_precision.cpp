// One run of a shear orbit by one method: what it cost, and where its nodes went, for perf/plot_work_precision.py and
// perf/stability_atlas.py. Arguments are key=value; fewer nodes on a section keep the bending stiffness.

#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/core/stopwatch.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/scene/words.hpp>

#include "perf/orbit_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <string>

namespace skein::perf {
namespace {

struct Choice {
  TimeMethod method = TimeMethod::rkc2;
  std::string output;
  double tolerance = 1e-4, step = 0.0, max_step = 0.0, length = 0.139, end = 6.0, stiffness = 1.0, blob = 1.0,
         sample = 0.25;
  int nodes = 6, sections = 0;
  bool verbose = false;
};

Choice read_choice(const int argc, char** argv) {
  Choice choice;
  const std::map<std::string, double*> numbers = {
      {"tolerance", &choice.tolerance}, {"step", &choice.step},    {"max_step", &choice.max_step},
      {"length", &choice.length},       {"end", &choice.end},      {"stiffness", &choice.stiffness},
      {"blob", &choice.blob},           {"sample", &choice.sample}};
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto equals = argument.find('=');
    const std::string key = argument.substr(0, equals), value = argument.substr(equals + 1);
    if (const auto number = numbers.find(key); number != numbers.end())
      *number->second = std::atof(value.c_str());
    else if (key == "method")
      choice.method = words_of<TimeMethod>().value_of(value);
    else if (key == "output")
      choice.output = value;
    else if (key == "sections")
      choice.sections = std::atoi(value.c_str());
    else if (key == "nodes")
      choice.nodes = std::atoi(value.c_str());
    else if (key == "verbose")
      choice.verbose = value != "0";
    else
      std::fprintf(stderr, "unknown argument %s\n", argument.c_str()), std::exit(64);
  }
  return choice;
}

SceneConfig make_scene(const Choice& choice) {
  SceneConfig scene = make_orbit_scene({choice.length, choice.nodes, choice.sections, choice.stiffness, choice.blob});
  scene.time.method = choice.method;
  scene.time.tolerance = choice.tolerance;
  scene.time.step = choice.step;
  if (choice.max_step > 0.0) scene.time.max_step = choice.max_step;
  scene.time.end = choice.end;
  return scene;
}

/// Positions of all nodes at multiples of an interval, raw doubles; nowhere where the name is empty.
class SampleFile {
 public:
  SampleFile(const std::string& name, const double interval, const std::size_t n_nodes)
      : interval_(interval), position_("sample", n_nodes) {
    if (!name.empty()) file_.open(name, std::ios::binary);
  }

  void write_up_to(const double time, const Integrator& integrator) {
    for (; static_cast<double>(count_) * interval_ <= time * (1.0 + 1e-14); ++count_) {
      integrator.interpolate(std::min(time, static_cast<double>(count_) * interval_), position_);
      for (const Vec3 x : to_host(ConstVectors(position_))) {
        const double values[3] = {x.x, x.y, x.z};
        file_.write(reinterpret_cast<const char*>(values), sizeof values);
      }
    }
  }

 private:
  double interval_;
  Vectors position_;
  std::int64_t count_ = 1;
  std::ofstream file_;
};

/// Sums over the steps of a run.
struct Tally {
  std::int64_t rejected = 0, stages = 0;
  double error = 0.0;        ///< over tolerance
  double local_error = 0.0;  ///< length
  double last_dt = 1.0;
  double seconds = 0.0, cpu_seconds = 0.0;

  void add(const StepReport& report) {
    rejected += report.rejected;
    stages += report.stages;
    error += report.error;
    local_error += report.local_error;
    last_dt = report.dt;
  }
};

void print_step(const StepReport& report, const State& state) {
  std::printf("step %lld t %.4f dt %.3e error %.3g stages %d radius %.4g rejected %d %s\n",
              static_cast<long long>(state.step), state.time, report.dt, report.error, report.stages,
              report.spectral_radius, report.rejected, report.rejection.c_str());
}

int run(const Choice& choice) {
  const SceneConfig scene = make_scene(choice);
  Physics physics = make_direct_physics(scene);
  const auto& fibers = physics.fibers;
  FiberDynamics dynamics(physics);
  const auto integrator = make_integrator(scene, physics, dynamics);
  State state{0.0, 0, to_device("position", make_surface_nodes(fibers))};
  const Vectors before("before", state.position.extent(0));
  SampleFile samples(choice.output, choice.sample, state.position.extent(0));
  Tally tally;
  bool failed = false;
  const auto start = WallClock::now();
  const std::clock_t cpu_start = std::clock();
  try {
    while (state.time < choice.end) {
      Kokkos::deep_copy(before, state.position);
      const StepReport report = integrator->advance(state, choice.end);
      tally.add(report);
      if (choice.verbose) print_step(report, state);
      samples.write_up_to(state.time, *integrator);
    }
  } catch (const std::exception& failure) {
    std::printf("failed t=%.4f %s\n", state.time, failure.what());
    failed = true;
  }
  tally.seconds = seconds_since(start);
  tally.cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;

  const double length = fibers[0].length();
  // Of nodes over the last step, shear rate times length: large where steps only alternate.
  const double speed = largest_distance(to_host(ConstVectors(state.position)), to_host(ConstVectors(before))) /
                       (tally.last_dt * make_background_flow(scene.flows)->typical_rate() * length);
  const auto n_steps = static_cast<double>(std::max<std::int64_t>(1, state.step));
  std::printf(
      "method=%s integrator=%s tolerance=%g nodes=%d sections=%d length=%.6g stiffness=%g t=%.6g evaluations=%lld "
      "steps=%lld rejected=%lld seconds=%.3f cpu=%.3f reported=%.4g mean_error=%.3g stages_per_step=%.3g speed=%.3g\n",
      word_of(choice.method).c_str(), word_of(integrator->method()).c_str(), choice.tolerance, choice.nodes,
      fibers[0].config.sections, length, choice.stiffness, state.time, static_cast<long long>(dynamics.evaluations()),
      static_cast<long long>(state.step), static_cast<long long>(tally.rejected), tally.seconds, tally.cpu_seconds,
      tally.local_error / length, tally.error / n_steps, static_cast<double>(tally.stages) / n_steps, speed);
  return failed ? 76 : 0;
}

}  // namespace
}  // namespace skein::perf

int main(int argc, char** argv) {
  skein::Runtime runtime;
  try {
    return skein::perf::run(skein::perf::read_choice(argc, argv));
  } catch (const skein::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
