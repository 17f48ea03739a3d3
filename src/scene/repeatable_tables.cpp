#include "repeatable_tables.hpp"

#include "key_ranges.hpp"

#include <algorithm>

namespace skein {
namespace {

void visit_flow(KeyVisitor& visitor, FlowConfig& flow) {
  visitor.choice({"kind", "", {}, "velocity"}, words_of<FlowKind>(), flow.kind);
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
}

void visit_start_shape(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.integer(
      {"start_mode", "", between(1, 1000),
       "half waves of the bend at the start; 1: a C, 2: an S. At most a quarter of the sections. Springs keep the "
       "straight fiber's lengths"},
      fiber.start_mode);
  visitor.number(
      {"start_amplitude", "", between(0.0, 0.2),
       "largest distance of a section from the line through the ends by that bend, as a fraction of the fiber's "
       "length; 0: straight. Springs may be strained by half of their length"},
      fiber.start_amplitude);
  visitor.number({"start_plane", "degrees", between(-360, 360),
                  "direction of that bend about the fiber; 0: towards y for a fiber along x, 90: towards z"},
                 fiber.start_plane);
  visitor.number(
      {"start_noise", "", between(0.0, 0.02),
       "random bends of 1 to 10 half waves, at most a quarter of the sections, in all directions, each with up "
       "to this amplitude as a fraction of the fiber's length; they follow from seed and the fiber's number"},
      fiber.start_noise);
}

void visit_rest_shape(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.number(
      {"helix_radius", "length", zero_or_more(),
       "distance of the centreline from the axis of a tube that is a helix at rest, about its direction; 0: it "
       "is straight at rest. The first section stands where that of the straight fiber would, on the axis"},
      fiber.helix_radius);
  visitor.number(
      {"helix_pitch", "length", any_number(), "along the axis, of a turn; above 0 right-handed, below 0 left-handed"},
      fiber.helix_pitch);
  visitor.number(
      {"helix_taper", "length", zero_or_more(),
       "the helix widens along the axis as radius (1 - exp(-(x / taper)^2)), x from the shaft on; 0: at once"},
      fiber.helix_taper);
  visitor.number({"helix_shaft", "length", zero_or_more(), "of the straight piece on the axis at the first end"},
                 fiber.helix_shaft);
}

void visit_springs(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.profile({"stiffness_profile",
                   "",
                   {0.0, largest_number, "2 to 64 pairs"},
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

void visit_chain(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.integer({"chain_nodes",
                   "",
                   {0.0, 1e9, "0, or 3 or more"},
                   "of a chain or a rigid fiber: how many nodes it has along the length of the tube it stands for; 0: "
                   "about two radii apart"},
                  fiber.chain_nodes);
  visitor.number({"bending_rigidity", "force * length^2", zero_or_more(),
                  "EI of a chain with nodes_per_section = 1, whose EA is spring_stiffness; other chains take both from "
                  "the tube. A rigid fiber is only judged by it"},
                 fiber.bending_rigidity);
  visitor.number({"shear_couple", "force * time", zero_or_more(),
                  "couple on a length of a chain or a rigid fiber with nodes_per_section = 1 that lies along a shear, "
                  "over its rate; others take it from the tube"},
                 fiber.shear_couple);
  visitor.number({"end_couple", "force * length * time", zero_or_more(),
                  "of the same with nodes_per_section = 1: the couple at either end, beside that on the length"},
                 fiber.end_couple);
}

void visit_fiber(KeyVisitor& visitor, FiberConfig& fiber) {
  visitor.choice({"model", "", {}, "what the fiber is made of"}, words_of<FiberModel>(), fiber.model);
  visitor.integer({"sections", "", between(2, 1e9), "number of circular cross-sections along the fiber"},
                  fiber.sections);
  visitor.integer({"nodes_per_section",
                   "",
                   {1.0, 1000.0, "3 to 1000, or 1"},
                   "number of nodes on a cross-section; 1: a chain or a rigid fiber that stands for no tube"},
                  fiber.nodes_per_section);
  visitor.number({"radius", "length", above_zero(), "radius of the cross-sections"}, fiber.radius);
  visitor.number(
      {"spacing", "length", zero_or_more(), "distance of sections; 0: as far apart as neighbouring nodes of one"},
      fiber.spacing);
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
  visit_rest_shape(visitor, fiber);
  visit_springs(visitor, fiber);
  visit_chain(visitor, fiber);
}

/// Of what acts on one fiber.
void visit_number_of_fiber(KeyVisitor& visitor, int& fiber) {
  visitor.integer({"fiber", "", between(0, 1e9), "number of the fiber, from 0, as the scene in the run folder has it"},
                  fiber);
}

void visit_tether(KeyVisitor& visitor, TetherConfig& tether) {
  visit_number_of_fiber(visitor, tether.fiber);
  visitor.integer({"section", "", between(-1e9, 1e9), "section that is held, from 0; -1 is the last"}, tether.section);
  visitor.number({"stiffness", "force / length", above_zero(), "force of the spring over the distance of its ends"},
                 tether.stiffness);
  visitor.vector({"point", "length", any_number(), "where it holds the section at t = 0"}, tether.point);
  visitor.vector({"velocity", "length / time", any_number(), "of that point"}, tether.velocity);
  visitor.vector({"swing", "length", any_number(), "added to the point times sin(angular_frequency t)"}, tether.swing);
  visitor.number({"angular_frequency", "radians / time", any_number(), "of the swing"}, tether.angular_frequency);
}

void visit_torque(KeyVisitor& visitor, TorqueConfig& torque) {
  visit_number_of_fiber(visitor, torque.fiber);
  visitor.integer({"section", "", between(-1e9, 1e9), "section that is turned, from 0; -1 is the last"},
                  torque.section);
  visitor.vector({"torque", "force * length", any_number(), "on the section at t = 0, in directions of space"},
                 torque.torque);
  visitor.vector({"angular_velocity", "radians / time", any_number(),
                  "at which the torque itself turns, about the direction of this vector; zero: a constant torque"},
                 torque.angular_velocity);
}

void visit_clamp(KeyVisitor& visitor, ClampConfig& clamp) {
  visit_number_of_fiber(visitor, clamp.fiber);
  visitor.integer({"section", "", between(-1e9, 1e9), "section that is held, from 0; -1 is the last"}, clamp.section);
  visitor.number(
      {"stiffness", "force / length", above_zero(),
       "of the springs that hold the section's nodes, together: force over the distance of its middle. Against "
       "tilting they hold with stiffness radius^2 / 2, so that two neighbouring sections hold a stiff fiber better"},
      clamp.stiffness);
  visitor.vector({"point", "length", any_number(), "where it holds the section's middle at t = 0"}, clamp.point);
  visitor.vector({"swing", "length", any_number(), "added to the point times sin(angular_frequency t)"}, clamp.swing);
  visitor.vector({"direction", "", any_number(), "of the fiber there; its length does not matter"}, clamp.direction);
  visitor.number({"roll", "degrees", between(-360, 360), "of the section about the direction, as a fiber's"},
                 clamp.roll);
  visitor.vector({"tilt", "degrees", any_number(),
                  "the frame turns about the axis of this vector by its length times sin(angular_frequency t)"},
                 clamp.tilt);
  visitor.number({"angular_frequency", "radians / time", any_number(), "of swing and tilt"}, clamp.angular_frequency);
  visitor.number(
      {"spin", "radians / time", any_number(), "at which the frame turns about the direction, from t = 0 on"},
      clamp.spin);
}

void visit_undulation(KeyVisitor& visitor, UndulationConfig& wave) {
  visit_number_of_fiber(visitor, wave.fiber);
  visitor.number({"curvature", "1 / length", any_number(), "that the fiber prefers where the wave is highest"},
                 wave.curvature);
  visitor.number({"wavelength", "length", zero_or_more(), "along the fiber; 0: the same phase everywhere"},
                 wave.wavelength);
  visitor.number({"angular_frequency", "radians / time", any_number(),
                  "above 0 the wave travels from the first section to the last, below 0 back"},
                 wave.angular_frequency);
  visitor.number({"phase", "degrees", between(-360, 360), "of the wave at the first section at t = 0; 0: highest"},
                 wave.phase);
  visitor.number({"plane", "degrees", between(-360, 360),
                  "side of the fiber towards which it bends, from node 0 of its sections; turns with the fiber. Node 0 "
                  "lies towards y for a fiber along x with roll 0, 90 degrees on is towards z"},
                 wave.plane);
  visitor.number({"ramp", "time", zero_or_more(), "over which the wave rises from t = 0 on; 0: it is there at once"},
                 wave.ramp);
  visitor.profile({"envelope",
                   "",
                   {0.0, largest_number, "2 to 64 pairs"},
                   "[position, factor] pairs, position 0 at the first section and 1 at the last: the wave is factor "
                   "times as high there, straight lines in between"},
                  wave.envelope);
}

/// @param visit_one  shows the keys of one
template <class Config>
RepeatableTable make_table(const std::string& name, const WhenAbsent when_absent,
                           std::vector<Config> SceneConfig::*const instances, void (*visit_one)(KeyVisitor&, Config&),
                           const std::string& meaning) {
  return {name, when_absent,
          [instances](SceneConfig& scene, const std::size_t n_instances) { (scene.*instances).resize(n_instances); },
          [=](KeyVisitor& visitor, SceneConfig& scene) {
            const Table table = {name, true, meaning, (scene.*instances).size(),
                                 when_absent == WhenAbsent::stands_for_none};
            for (Config& instance : scene.*instances) {
              visitor.begin_table(table);
              visit_one(visitor, instance);
              visitor.end_table();
            }
          }};
}

}  // namespace

const std::vector<RepeatableTable>& repeatable_tables() {
  static const std::vector<RepeatableTable> tables = {
      make_table(
          "flow", WhenAbsent::stands_for_one, &SceneConfig::flows, visit_flow,
          "The flow that would be there without fibers; [[flow]] once for each of several, whose velocities are added. "
          "r is the rate at the time, x, y and z are measured from the center."),
      make_table(
          "fiber", WhenAbsent::is_an_error, &SceneConfig::fibers, visit_fiber,
          "A tube of surface nodes, or a line of single ones, straight at rest; [[fiber]] once for each of several."),
      make_table(
          "tether", WhenAbsent::stands_for_none, &SceneConfig::tethers, visit_tether,
          "A spring that holds a section of a fiber at a point of space, which may move; [[tether]] once for each "
          "of several."),
      make_table("torque", WhenAbsent::stands_for_none, &SceneConfig::torques, visit_torque,
                 "A torque on a section of a fiber, constant or turning; [[torque]] once for each of several."),
      make_table("undulation", WhenAbsent::stands_for_none, &SceneConfig::undulations, visit_undulation,
                 "A wave of curvature that a tube prefers to being straight, so that it swims; [[undulation]] once for "
                 "each of several, which are added."),
      make_table(
          "clamp", WhenAbsent::stands_for_none, &SceneConfig::clamps, visit_clamp,
          "A frame that holds a section of a tube and its direction, and may swing, tilt and spin; [[clamp]] once "
          "for each of several.")};
  return tables;
}

const RepeatableTable* find_repeatable_table(const std::string& name) {
  const auto& tables = repeatable_tables();
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const auto& table) { return table.name == name; });
  return found == tables.end() ? nullptr : &*found;
}

SceneConfig make_scene_with_every_table() {
  SceneConfig scene;
  for (const RepeatableTable& table : repeatable_tables()) table.resize(scene, 1);
  return scene;
}

}  // namespace skein
