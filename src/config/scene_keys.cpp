#include "scene_keys.hpp"

#include <fmt/format.h>

#include "scene_value.hpp"

namespace skein {
namespace {

// No scene needs more, and products of a few such numbers stay far from overflow and underflow.
constexpr double largest = 1e15;
constexpr double smallest = 1e-15;

Range any_number() { return {-largest, largest, ""}; }
Range above_zero() { return {smallest, largest, "above 0"}; }
Range zero_or_more() { return {0.0, largest, "0 or more"}; }
Range between(const double low, const double high) { return {low, high, fmt::format("{} to {}", low, high)}; }

void visit_fluid(KeyVisitor& visitor, FluidConfig& fluid) {
  visitor.begin_table({"fluid", false, "The fluid: Stokes flow in free space."});
  visitor.number({"viscosity", "force * time / length^2", above_zero(), "dynamic viscosity"}, fluid.viscosity);
  visitor.end_table();
}

void visit_flow(KeyVisitor& visitor, FlowConfig& flow) {
  visitor.begin_table({"flow", false, "The flow that would be there without fibers."});
  visitor.choice({"kind", "", {}, "background flow"},
                 {{"shear", "velocity (rate * y, 0, 0)"}, {"none", "fluid at rest far away"}}, flow.kind);
  visitor.number({"rate", "1 / time", any_number(), "shear rate"}, flow.rate);
  visitor.end_table();
}

void visit_fiber(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.begin_table(
      {"fiber", true, "A tube of surface nodes, straight at rest; [[fiber]] once for each of several."});
  visitor.integer({"sections", "", between(2, 1e9), "number of circular cross-sections along the fiber"},
                  fiber.sections);
  visitor.integer({"nodes_per_section", "", between(3, 1000),
                   "number of nodes on a cross-section; sections lie as far apart as neighbouring nodes of one"},
                  fiber.nodes_per_section);
  visitor.number({"radius", "length", above_zero(), "radius of the cross-sections"}, fiber.radius);
  visitor.number({"spring_stiffness", "force", above_zero(), "force of a spring stretched to twice its rest length"},
                 fiber.spring_stiffness);
  visitor.number({"blob", "length", above_zero(),
                  "regularization length of the nodes' forces; below the radius, about the distance of nodes"},
                 fiber.blob);
  visitor.vector({"center", "length", any_number(), "middle of the fiber at the start"}, fiber.center);
  visitor.vector({"direction", "", any_number(), "direction of the fiber at the start; its length does not matter"},
                 fiber.direction);
  visitor.number({"roll", "degrees", between(-360, 360), "rotation of the fiber about its direction"}, fiber.roll);
  visitor.end_table();
}

void visit_hydrodynamics(KeyVisitor& visitor, HydrodynamicsConfig& hydrodynamics) {
  visitor.begin_table({"hydrodynamics", false, "How velocities follow from forces."});
  visitor.choice({"method", "", {}, "how the sum over nodes is made"}, {{"direct", "every pair of nodes"}},
                 hydrodynamics.method);
  visitor.choice({"precision", "", {}, "arithmetic of a pair of nodes"},
                 {{"double", "16 digits"}, {"single", "7 digits, about twice as fast"}}, hydrodynamics.precision);
  visitor.end_table();
}

void visit_time(KeyVisitor& visitor, TimeConfig& time) {
  visitor.begin_table({"time", false, "How time advances."});
  visitor.choice({"method", "", {}, "time integration"},
                 {{"auto", "rkc2 or trbdf2, whichever is expected to do with less work; the log says why"},
                  {"rkc2", "stabilized Runge-Kutta-Chebyshev of second order, with error control"},
                  {"trbdf2", "implicit of second order, with GMRES and error control: for very stiff springs"},
                  {"rk4", "explicit Runge-Kutta of fourth order, with error control; bound by stability"},
                  {"bs3", "explicit Runge-Kutta of third order by Bogacki and Shampine, with error control; likewise"},
                  {"euler", "forward Euler with a fixed step"}},
                 time.method);
  visitor.number({"end", "time", zero_or_more(), "time at which the run ends; it starts at 0"}, time.end);
  visitor.number({"step", "time", zero_or_more(), "fixed step; 0 leaves it to the error control; euler needs one"}, time.step);
  visitor.number({"tolerance", "", between(1e-12, 1.0),
                  "error allowed per unit of time, as a fraction of the longest fiber's length"},
                 time.tolerance);
  visitor.number({"max_step", "time", above_zero(), "largest step"}, time.max_step);
  visitor.end_table();
}

void visit_output(KeyVisitor& visitor, OutputConfig& output) {
  visitor.begin_table({"output", false, "What the run folder holds."});
  visitor.number({"frame_interval", "time", above_zero(), "time from frame to frame; the start and the end have one"},
                 output.frame_interval);
  visitor.choice({"precision", "", {}, "numbers of the positions in frames; checkpoints are always double"},
                 {{"double", "16 digits"}, {"single", "7 digits, half the disk space"}}, output.precision);
  visitor.end_table();
}

void visit_checkpoint(KeyVisitor& visitor, CheckpointConfig& checkpoint) {
  visitor.begin_table({"checkpoint", false, "From what `skein resume` goes on; one is made at the end of a run, too."});
  visitor.number({"wall_interval", "seconds of wall time", zero_or_more(), "a checkpoint so often; 0: not by the clock"},
                 checkpoint.wall_interval);
  visitor.number({"simulated_interval", "time", zero_or_more(), "a checkpoint so often; 0: not by simulated time"},
                 checkpoint.simulated_interval);
  visitor.integer({"keep", "", between(1, 1e6), "how many are kept, the newest"}, checkpoint.keep);
  visitor.end_table();
}

}  // namespace

void visit_keys(KeyVisitor& visitor, SceneConfig& scene) {
  visitor.begin_table({"", false, "The scene as a whole."});
  visitor.text({"title", "", {}, "any text; it is kept with the results"}, scene.title);
  visitor.integer({"seed", "", {0.0, 1e19, "0 or more"}, "start of all random numbers"}, scene.seed);
  visit_fluid(visitor, scene.fluid);
  visit_flow(visitor, scene.flow);
  for (FiberConfig& fiber : scene.fibers) visit_fiber(visitor, fiber);
  visit_hydrodynamics(visitor, scene.hydrodynamics);
  visit_time(visitor, scene.time);
  visit_output(visitor, scene.output);
  visit_checkpoint(visitor, scene.checkpoint);
  visitor.end_table();
}

std::string describe_key(const std::string& path, const Key& key, const std::string& default_value) {
  std::string description = path + ": " + key.meaning;
  if (!key.unit.empty()) description += "; " + key.unit;
  if (!key.range.text.empty()) description += "; " + key.range.text;
  return description + "; default " + default_value;
}

std::string list_choices(const std::vector<Choice>& choices) {
  std::string list;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) list += i + 1 < choices.size() ? ", " : " or ";
    list += format_text(choices[i].word);
  }
  return list;
}

std::string format_vector(const Vec3& vector) {
  return fmt::format("[{}, {}, {}]", format_number(vector.x), format_number(vector.y), format_number(vector.z));
}

}  // namespace skein
