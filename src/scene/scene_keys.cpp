#include "scene_keys.hpp"

#include "key_ranges.hpp"
#include "repeatable_tables.hpp"
#include "scene_value.hpp"

#include <fmt/format.h>

#include <limits>

namespace skein {
namespace {

void visit_fluid(KeyVisitor& visitor, FluidConfig& fluid) {
  visitor.begin_table({"fluid", false, "The fluid: Stokes flow in free space."});
  visitor.number({"viscosity", "force * time / length^2", above_zero(), "dynamic viscosity"}, fluid.viscosity);
  visitor.end_table();
}

void visit_placement(KeyVisitor& visitor, PlacementConfig& placement) {
  visitor.begin_table({"placement", false,
                       "Many fibers from few: copies of the scene's fibers, taken in turn. The scene in the run folder "
                       "lists each copy."});
  visitor.choice({"kind", "", {}, "where fibers stand"}, words_of<PlacementKind>(), placement.kind);
  visitor.vector({"center", "length", any_number(), "middle of the grid or the box"}, placement.center);
  visitor.vector({"grid", "", {1.0, 10000.0, "1 to 10000"}, "numbers of fibers along x, y and z"}, placement.grid);
  visitor.vector({"spacing", "length", any_number(), "distances of the grid along x, y and z"}, placement.spacing);
  visitor.integer({"count", "", between(1, 10000), "number of random fibers"}, placement.count);
  visitor.vector({"box", "length", above_zero(), "sides of the box that holds random fibers, ends included"},
                 placement.box);
  visitor.number({"gap", "length", zero_or_more(), "smallest distance of the surfaces of random fibers"},
                 placement.gap);
  visitor.choice({"orientation", "", {}, "directions of the copies"}, words_of<Orientation>(), placement.orientation);
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

void visit_gravity(KeyVisitor& visitor, GravityConfig& gravity) {
  visitor.begin_table(
      {"gravity", false,
       "The weight of fibers in the fluid, less the fluid's. A fiber that settles drags the fluid along: "
       "velocities fall off like 1 / distance, and a crowd settles faster than one."});
  visitor.number({"weight", "force / length", zero_or_more(),
                  "excess weight of a length of fiber, shared equally by its nodes; 0: none"},
                 gravity.weight);
  visitor.vector({"direction", "", any_number(), "where it pulls to; its length does not matter"}, gravity.direction);
  visitor.end_table();
}

void visit_symmetry(KeyVisitor& visitor, SymmetryConfig& symmetry) {
  visitor.begin_table(
      {"symmetry", false,
       "What maps the scene onto itself: its fibers as they start, its flow and its forces. Velocities are then found "
       "for a half of the nodes, or with both keys for a quarter, from these nodes and their images, in as much less "
       "time, and the motion stays symmetric to the last bit: that a fiber keeps to its plane, or stays odd about its "
       "middle, is then an assumption and no result. A scene without the symmetry is refused."});
  visitor.choice({"mirror", "", {}, "normal of a plane of symmetry through the origin"}, words_of<SymmetryAxis>(),
                 symmetry.mirror);
  visitor.choice({"half_turn", "", {}, "axis through the origin about which a turn by 180 degrees changes nothing"},
                 words_of<SymmetryAxis>(), symmetry.half_turn);
  visitor.end_table();
}

void visit_hydrodynamics(KeyVisitor& visitor, HydrodynamicsConfig& hydrodynamics) {
  visitor.begin_table({"hydrodynamics", false, "How velocities follow from forces."});
  visitor.choice({"method", "", {}, "how the sum over nodes is made"}, words_of<SumMethod>(), hydrodynamics.method);
  visitor.choice({"precision", "", {}, "arithmetic of a pair of nodes"}, words_of<Precision>(),
                 hydrodynamics.precision);
  visitor.number({"tolerance", "", between(0, 0.01),
                  "error of all velocities together (2-norm, relative) that fmm may make: the order, precision and "
                  "smallest leaves follow from it; 0: 2.5 time.tolerance times the time scale, from 1e-6 to 1e-3, that "
                  "is 1e-4 unless time.tolerance is set; 1e-5 with a fixed step"},
                 hydrodynamics.tolerance);
  visitor.choice({"far_field", "", {}, "how fmm sees distant nodes"}, words_of<FarField>(), hydrodynamics.far_field);
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
  visitor.choice({"on_miss", "", {}, "when a check finds more error than the tolerance"}, words_of<OnMiss>(),
                 hydrodynamics.on_miss);
  visitor.end_table();
}

void visit_time(KeyVisitor& visitor, TimeConfig& time) {
  visitor.begin_table({"time", false, "How time advances."});
  visitor.choice({"method", "", {}, "time integration"}, words_of<TimeMethod>(), time.method);
  visitor.number({"start", "time", zero_or_more(),
                  "time at which the run starts; `skein run --from` sets it to that of the earlier run"},
                 time.start);
  visitor.number({"end", "time", zero_or_more(), "time at which the run ends"}, time.end);
  visitor.numbers({"earlier_ends",
                   "time",
                   {0.0, largest_number, "0 to 64 times"},
                   "where the run ended before `skein resume --set time.end=LATER` prolonged it, which writes them: "
                   "steps end there, and frames are there"},
                  time.earlier_ends);
  visitor.number({"step", "time", zero_or_more(), "fixed step; 0 leaves it to the error control; euler needs one"},
                 time.step);
  visitor.number(
      {"tolerance", "1 / time", zero_or_more(),
       "error allowed per unit of time, as a fraction of the longest fiber's length; 0: 4e-5 per time scale, "
       "1e-4 in shear of rate 2.5. The time scale is 1 / rate of the flow; where a weight, a torque or a "
       "moving tether carries a fiber over its length sooner, or a wave's period is shorter, that time; in a fluid at "
       "rest that in which a "
       "bent fiber relaxes"},
      time.tolerance);
  visitor.number({"max_step",
                  "time",
                  {0.0, std::numeric_limits<double>::infinity(), "0 or more, or inf"},
                  "largest step; 0: a quarter of the time scale; inf: as the tolerance allows"},
                 time.max_step);
  visitor.end_table();
}

void visit_start(KeyVisitor& visitor, StartConfig& start) {
  visitor.begin_table(
      {"start", false,
       "The state of another run that the run begins with. `skein run --from` writes these keys and puts "
       "the positions of all nodes into start-CHECKSUM.checkpoint beside the scene; the time is time.start."});
  visitor.text({"checksum", "", {}, "xxh3 of that file; empty: the fibers start as they are written"}, start.checksum);
  visitor.text({"parent", "", {}, "folder of the other run, as it was named"}, start.parent);
  visitor.text({"certificate", "", {}, "of the other run, as `skein verify` prints it"}, start.certificate);
  visitor.integer({"step", "", {0.0, 1e18, "0 or more"}, "steps that the other run had taken"}, start.step);
  visitor.end_table();
}

void visit_output(KeyVisitor& visitor, OutputConfig& output) {
  visitor.begin_table({"output", false, "What the run folder holds."});
  visitor.number({"frame_interval", "time", zero_or_more(),
                  "time from frame to frame; the start and the end have one; 0: an eighth of the time scale"},
                 output.frame_interval);
  visitor.choice({"precision", "", {}, "numbers of the positions in frames; checkpoints are always double"},
                 words_of_stored_precision(), output.precision);
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
  for (const RepeatableTable& table : repeatable_tables()) table.visit(visitor, scene);
  visit_placement(visitor, scene.placement);
  visit_repulsion(visitor, scene.repulsion);
  visit_gravity(visitor, scene.gravity);
  visit_symmetry(visitor, scene.symmetry);
  visit_hydrodynamics(visitor, scene.hydrodynamics);
  visit_time(visitor, scene.time);
  visit_start(visitor, scene.start);
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

std::string format_profile(const std::vector<ProfilePoint>& profile) {
  std::string list;
  for (const ProfilePoint& point : profile)
    list +=
        fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", format_number(point.position), format_number(point.factor));
  return "[" + list + "]";
}

std::string format_numbers(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers) list += (list.empty() ? "" : ", ") + format_number(number);
  return "[" + list + "]";
}

std::string format_vector(const Vec3& vector) {
  return fmt::format("[{}, {}, {}]", format_number(vector.x), format_number(vector.y), format_number(vector.z));
}

}  // namespace skein
