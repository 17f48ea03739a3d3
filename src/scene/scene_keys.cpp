#include "scene_keys.hpp"

#include "scene_value.hpp"

#include <fmt/format.h>

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

void visit_flow(KeyVisitor& visitor, FlowConfig& flow, const std::size_t n_flows) {
  visitor.begin_table(
      {"flow", true,
       "The flow that would be there without fibers; [[flow]] once for each of several, whose velocities are added. "
       "r is the rate at the time, x, y and z are measured from the center.",
       n_flows});
  visitor.choice({"kind", "", {}, "velocity"},
                 {{"shear", "(r y, 0, 0)"},
                  {"planar_extension", "(-r x, r y, 0), which compresses along x for r above 0"},
                  {"uniaxial_extension", "(r x, -r y/2, -r z/2), which stretches along x for r above 0"},
                  {"rotation", "(-r y, r x, 0), as a rigid body"},
                  {"poiseuille", "(r size/2 (1 - (y/size)^2), 0, 0), between planes y = -size and size"},
                  {"vortices", "r/k (sin(k x) cos(k y), -cos(k x) sin(k y), 0) with k = pi/size, square cells"},
                  {"none", "fluid at rest far away"}},
                 flow.kind);
  visitor.number(
      {"rate", "1 / time", any_number(),
       "shear rate; of extensions the stretching rate along x or y; of the rotation the angular velocity; of "
       "poiseuille the shear rate at the planes; of vortices the stretching rate at the corners of cells"},
      flow.rate);
  visitor.vector({"center", "length", any_number(), "origin of the flow"}, flow.center);
  visitor.number({"size", "length", above_zero(), "half width of poiseuille, side of a cell of vortices"}, flow.size);
  visitor.number({"angular_frequency", "radians / time", any_number(),
                  "of an oscillating flow: r = rate cos(angular_frequency t + phase)"},
                 flow.angular_frequency);
  visitor.number({"phase", "degrees", between(-360, 360), "of an oscillating flow; 0 starts at the full rate"},
                 flow.phase);
  visitor.number({"start", "time", zero_or_more(), "no flow before"}, flow.start);
  visitor.number({"stop", "time", zero_or_more(), "no flow after; 0: it never stops"}, flow.stop);
  visitor.number({"ramp", "time", zero_or_more(), "time over which the flow rises after start and falls after stop"},
                 flow.ramp);
  visitor.end_table();
}

void visit_start_shape(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.integer({"start_mode", "", between(1, 1000),
                   "half waves of the bend at the start; 1: a C, 2: an S. Springs keep the straight fiber's lengths"},
                  fiber.start_mode);
  visitor.number({"start_amplitude", "", between(0.0, 0.2),
                  "largest deflection of that bend, as a fraction of the fiber's length; 0: straight"},
                 fiber.start_amplitude);
  visitor.number({"start_plane", "degrees", between(-360, 360),
                  "direction of that bend about the fiber; 0: towards y for a fiber along x, 90: towards z"},
                 fiber.start_plane);
  visitor.number({"start_noise", "", between(0.0, 0.02),
                  "random bends of 1 to 10 half waves in all directions, each with up to this amplitude as a fraction "
                  "of the fiber's length; they follow from seed and the fiber's number"},
                 fiber.start_noise);
}

void visit_springs(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.profile({"stiffness_profile",
                   "",
                   {0.0, largest, "2 to 64 pairs"},
                   "[position, factor] pairs, position 0 at the first section and 1 at the last: springs are factor "
                   "times as stiff there, straight lines in between"},
                  fiber.stiffness_profile);
  visitor.number({"stiffness_within_sections", "", above_zero(), "factor of the springs inside sections"},
                 fiber.stiffness_within_sections);
  visitor.number({"stiffness_between_sections", "", above_zero(), "factor of the springs from section to section"},
                 fiber.stiffness_between_sections);
  visitor.integer({"reach_along", "", between(1, 8), "springs join sections up to this far apart"}, fiber.reach_along);
  visitor.integer({"reach_around", "", between(0, 500),
                   "springs join nodes whose places on their sections differ by up to this; 0: all"},
                  fiber.reach_around);
}

void visit_fiber(KeyVisitor& visitor, FiberConfig& fiber, const std::size_t n_fibers) {
  visitor.begin_table(
      {"fiber", true, "A tube of surface nodes, straight at rest; [[fiber]] once for each of several.", n_fibers});
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
  visit_start_shape(visitor, fiber);
  visit_springs(visitor, fiber);
  visitor.end_table();
}

void visit_placement(KeyVisitor& visitor, PlacementConfig& placement) {
  visitor.begin_table({"placement", false,
                       "Many fibers from few: copies of the scene's fibers, taken in turn. The scene in the run folder "
                       "lists each copy."});
  visitor.choice({"kind", "", {}, "where fibers stand"},
                 {{"as_written", "each [fiber] once, where it says"},
                  {"grid", "copies on a grid"},
                  {"random", "copies inside a box, anywhere they do not touch"}},
                 placement.kind);
  visitor.vector({"center", "length", any_number(), "middle of the grid or the box"}, placement.center);
  visitor.vector({"grid", "", {1.0, 10000.0, "1 to 10000"}, "numbers of fibers along x, y and z"}, placement.grid);
  visitor.vector({"spacing", "length", any_number(), "distances of the grid along x, y and z"}, placement.spacing);
  visitor.integer({"count", "", between(1, 10000), "number of random fibers"}, placement.count);
  visitor.vector({"box", "length", above_zero(), "sides of the box that holds random fibers, ends included"},
                 placement.box);
  visitor.number({"gap", "length", zero_or_more(), "smallest distance of the surfaces of random fibers"},
                 placement.gap);
  visitor.choice({"orientation", "", {}, "directions of the copies"},
                 {{"as_written", "as the fibers say"}, {"random", "evenly over the sphere"}}, placement.orientation);
  visitor.end_table();
}

void visit_repulsion(KeyVisitor& visitor, RepulsionConfig& repulsion) {
  visitor.begin_table(
      {"repulsion", false,
       "What keeps fibers, and sections of one fiber with 10 radii or more of it between them, from "
       "touching. Sections whose surfaces have a gap below range push each other along the line of "
       "their centers, with the energy strength * spacing * spacing' * (1 - gap/range)^3 / 3. At contact "
       "parallel fibers push with 2.1 strength sqrt(radius/range) per length, fibers that cross at right "
       "angles with 4.2 strength radius. strength = viscosity * rate * length^2 / radius holds fibers that "
       "a flow presses together about half a range apart, ten times as much 0.8 ranges; the length is "
       "that of the fiber or, if it is shorter, of a piece that stays straight, 4 (EI/(viscosity "
       "rate))^(1/4). `skein validate` compares these forces."});
  visitor.number({"strength", "force / length", zero_or_more(), "of the repulsion; 0: none"}, repulsion.strength);
  visitor.number({"range", "length", zero_or_more(),
                  "distance of surfaces from which on they repel each other; 0: the radius of the thinnest fiber; "
                  "0.01 to 4 of these"},
                 repulsion.range);
  visitor.end_table();
}

void visit_hydrodynamics(KeyVisitor& visitor, HydrodynamicsConfig& hydrodynamics) {
  visitor.begin_table({"hydrodynamics", false, "How velocities follow from forces."});
  visitor.choice({"method", "", {}, "how the sum over nodes is made"},
                 {{"auto", "fmm where the scene is large enough for it to be faster, else direct"},
                  {"direct", "every pair of nodes; the keys from tolerance on have no effect"},
                  {"fmm", "fast multipole method"}},
                 hydrodynamics.method);
  visitor.choice({"precision", "", {}, "arithmetic of a pair of nodes"},
                 {{"auto", "double in direct sums; in fmm as the tolerance allows"},
                  {"double", "16 digits"},
                  {"single", "7 digits, about twice as fast"}},
                 hydrodynamics.precision);
  visitor.number({"tolerance", "", between(1e-15, 0.01),
                  "error of all velocities together (2-norm, relative) that fmm may make: the order, precision and "
                  "smallest leaves follow from it"},
                 hydrodynamics.tolerance);
  visitor.choice({"far_field", "", {}, "how fmm sees distant nodes"},
                 {{"harmonic", "four harmonic potentials: the fastest and most exact"},
                  {"stokeslet", "singular Stokeslets"},
                  {"regularized", "regularized Stokeslets; one blob for all fibers"}},
                 hydrodynamics.far_field);
  visitor.integer({"order", "", between(0, 16),
                   "points per edge of fmm's surfaces; 0: as the tolerance needs; one that does not promise the "
                   "tolerance is an error, a higher one is used as it is"},
                  hydrodynamics.order);
  visitor.integer({"leaf_size", "", between(0, 100000),
                   "nodes that fmm aims at in a leaf of its tree; 0: as the order needs; leaves stay as large as the "
                   "tolerance needs in either case"},
                  hydrodynamics.leaf_size);
  visitor.integer({"check_every", "", between(0, 1e9),
                   "evaluations by fmm from one check to the next: 64 of the velocities are compared with direct sums; "
                   "0: none"},
                  hydrodynamics.check_every);
  visitor.choice({"on_miss", "", {}, "when a check finds more error than the tolerance"},
                 {{"raise_order", "say so, mend this evaluation and go on with a higher order"},
                  {"stop", "end the run with exit code 76"}},
                 hydrodynamics.on_miss);
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
  visitor.number({"step", "time", zero_or_more(), "fixed step; 0 leaves it to the error control; euler needs one"},
                 time.step);
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
  visitor.number(
      {"wall_interval", "seconds of wall time", zero_or_more(), "a checkpoint so often; 0: not by the clock"},
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
  for (FlowConfig& flow : scene.flows) visit_flow(visitor, flow, scene.flows.size());
  for (FiberConfig& fiber : scene.fibers) visit_fiber(visitor, fiber, scene.fibers.size());
  visit_placement(visitor, scene.placement);
  visit_repulsion(visitor, scene.repulsion);
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

std::string format_profile(const std::vector<ProfilePoint>& profile) {
  std::string list;
  for (const ProfilePoint& point : profile)
    list +=
        fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", format_number(point.position), format_number(point.factor));
  return "[" + list + "]";
}

std::string format_vector(const Vec3& vector) {
  return fmt::format("[{}, {}, {}]", format_number(vector.x), format_number(vector.y), format_number(vector.z));
}

}  // namespace skein
