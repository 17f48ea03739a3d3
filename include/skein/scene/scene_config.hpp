#pragma once

#include <skein/core/vec3.hpp>
#include <skein/scene/choices.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

// What a scene says, as plain structs with the defaults that `skein defaults` prints. Units are those of the scene:
// length, time, and force = viscosity * length^2 / time. Each key's meaning, unit and range stand where it is read,
// once: src/scene/scene_keys.cpp, and src/scene/repeatable_tables.cpp for tables of which there may be several.

struct FluidConfig {
  double viscosity = 1.0;  ///< > 0, force * time / length^2
  friend bool operator==(const FluidConfig&, const FluidConfig&) = default;
};

/// A part of the flow far from all fibers; several instances add up. With x, y, z measured from `center` and r(t) the
/// rate at time t, its velocity is
///   shear               (r y, 0, 0)
///   planar_extension    (-r x, r y, 0)
///   uniaxial_extension  (r x, -r y/2, -r z/2)
///   rotation            (-r y, r x, 0)
///   poiseuille          (r size/2 (1 - (y/size)^2), 0, 0)
///   vortices            r/k (sin(k x) cos(k y), -cos(k x) sin(k y), 0), k = pi/size
///   none                0
struct FlowConfig {
  FlowKind kind = FlowKind::shear;
  double rate = 2.5;               ///< 1 / time
  Vec3 center{0.0, 0.0, 0.0};      ///< length
  double size = 1.0;               ///< > 0, length
  double angular_frequency = 0.0;  ///< r(t) = rate cos(angular_frequency t + phase), radians / time
  double phase = 0.0;              ///< degrees
  double start = 0.0;              ///< time; zero before
  double stop = 0.0;               ///< time; zero after; 0: never
  double ramp = 0.0;               ///< time that rise and fall take
  friend bool operator==(const FlowConfig&, const FlowConfig&) = default;
};

/// Springs at `position` along a fiber (0: first section, 1: last) are `factor` times as stiff.
struct ProfilePoint {
  double position = 0.0, factor = 1.0;
  friend bool operator==(const ProfilePoint&, const ProfilePoint&) = default;
};

/// One tube of surface nodes, or a line of single ones, straight or a helix at rest; several instances make several
/// fibers.
///
/// A line is a chain or rigid. One whose nodes_per_section is 1 is what its keys say: spring_stiffness is EA. One with
/// more nodes stands for the tube of the same keys and is turned into the other kind by resolve_chains.
struct FiberConfig {
  FiberModel model = FiberModel::tube;
  int sections = 80;                 ///< N_f, >= 2
  int nodes_per_section = 18;        ///< N_c, >= 3; 1 for a line as such
  double radius = 0.005;             ///< R, length
  double spring_stiffness = 0.0112;  ///< k, force
  double blob = 0.00225;             ///< regularization length eps of this fiber's nodes
  Vec3 center{0.0, 0.0, 0.0};        ///< length
  Vec3 direction{1.0, 0.0, 0.0};     ///< any length but zero
  double roll = 0.0;                 ///< degrees, about the direction

  int start_mode = 1;            ///< half waves of the bend at the start, >= 1
  double start_amplitude = 0.0;  ///< of that bend from the line through the ends, as a fraction of the fiber's length
  double start_plane = 0.0;      ///< degrees about the direction; 0: towards y for a fiber along x
  double start_noise = 0.0;      ///< amplitude of random bends, as a fraction of the fiber's length

  double helix_radius = 0.0;  ///< of the rest shape, length; 0: straight
  double helix_pitch = 0.1;   ///< along its axis for a turn, length; below 0: left-handed
  double helix_taper = 0.0;   ///< along the axis, over which the radius rises, length
  double helix_shaft = 0.0;   ///< straight piece at the first end, length

  std::vector<ProfilePoint> stiffness_profile{{0.0, 1.0}, {1.0, 1.0}};  ///< straight lines between the points
  double stiffness_within_sections = 1.0;                               ///< factor of spring_stiffness
  double stiffness_between_sections = 1.0;                              ///< factor of spring_stiffness
  int reach_along = 1;                                                  ///< springs join sections up to this far apart
  int reach_around = 0;  ///< ... and nodes whose places on their sections differ by up to this; 0: all
  double spacing = 0.0;  ///< ds between sections, length; 0: the chord between neighbours on a section

  int chain_nodes = 0;            ///< of a line in a tube's stead; 0: about two radii apart
  double bending_rigidity = 0.0;  ///< EI of a line as such, force * length^2; a rigid one is judged by it, not bent
  double shear_couple = 0.0;      ///< of a line as such: couple per length and rate of shear, force * time
  double end_couple = 0.0;        ///< of a line as such: couple per rate of shear at each end, force * length * time

  /// True where single nodes on the centreline make the fiber, or will when it is laid out.
  bool is_line() const { return model != FiberModel::tube; }
  bool is_rigid() const { return model == FiberModel::rigid; }
  bool is_helix() const { return helix_radius > 0.0; }
  /// True where it waits to be turned into a line with numbers of its own, see resolve_chains.
  bool stands_for_tube() const { return is_line() && nodes_per_section > 1; }
  friend bool operator==(const FiberConfig&, const FiberConfig&) = default;
};

/// Where the fibers of a scene stand.
struct PlacementConfig {
  PlacementKind kind = PlacementKind::as_written;
  Vec3 center{0.0, 0.0, 0.0};   ///< of grid or box, length
  Vec3 grid{1.0, 1.0, 1.0};     ///< numbers of fibers along x, y, z
  Vec3 spacing{0.1, 0.1, 0.1};  ///< of the grid, length
  int count = 10;               ///< of random fibers
  Vec3 box{1.0, 1.0, 1.0};      ///< sides of the box that holds random fibers, length
  double gap = 0.0;             ///< between surfaces of random fibers at least, length
  Orientation orientation = Orientation::as_written;
  friend bool operator==(const PlacementConfig&, const PlacementConfig&) = default;
};

/// What keeps fibers, and distant sections of one, from touching. Two sections with a gap g < range between their
/// surfaces, each standing for its fiber's spacing, have the energy strength spacing spacing' (1 - g/range)^3 / 3.
struct RepulsionConfig {
  double strength = 0.0;  ///< force / length; 0: none
  double range = 0.0;     ///< length; 0: the radius of the thinnest fiber
  friend bool operator==(const RepulsionConfig&, const RepulsionConfig&) = default;
};

/// The weight of fibers in the fluid, less the fluid's.
struct GravityConfig {
  double weight = 0.0;             ///< of a length of fiber, force / length; 0: none
  Vec3 direction{0.0, 0.0, -1.0};  ///< any length but zero
  friend bool operator==(const GravityConfig&, const GravityConfig&) = default;
};

/// A spring that holds a section of a fiber at a point, which may move:
/// point + velocity t + swing sin(angular_frequency t). Its length at rest is zero.
struct TetherConfig {
  int fiber = 0;
  int section = 0;         ///< from 0, or from the end as -1
  double stiffness = 1.0;  ///< force / length
  Vec3 point{0.0, 0.0, 0.0}, velocity{0.0, 0.0, 0.0}, swing{0.0, 0.0, 0.0};
  double angular_frequency = 0.0;  ///< radians / time
  friend bool operator==(const TetherConfig&, const TetherConfig&) = default;
};

/// A torque on a section of a fiber, as forces on its nodes whose sum is zero; it turns about angular_velocity.
struct TorqueConfig {
  int fiber = 0;
  int section = 0;                       ///< from 0, or from the end as -1
  Vec3 torque{0.0, 0.0, 0.0};            ///< at t = 0, force * length
  Vec3 angular_velocity{0.0, 0.0, 0.0};  ///< of its direction, radians / time
  friend bool operator==(const TorqueConfig&, const TorqueConfig&) = default;
};

/// A frame that holds a section of a tube: each of its nodes by a spring without a rest length, at its place about
/// point + swing sin(angular_frequency t), turned by tilt sin(angular_frequency t) and spun about the direction.
struct ClampConfig {
  int fiber = 0;
  int section = 0;         ///< from 0, or from the end as -1
  double stiffness = 1.0;  ///< of all springs together, force / length
  Vec3 point{0.0, 0.0, 0.0}, swing{0.0, 0.0, 0.0};
  Vec3 direction{1.0, 0.0, 0.0};   ///< of the fiber there, any length but zero
  double roll = 0.0;               ///< degrees, as a fiber's
  Vec3 tilt{0.0, 0.0, 0.0};        ///< degrees about the axis of this direction
  double angular_frequency = 0.0;  ///< of swing and tilt, radians / time
  double spin = 0.0;               ///< about the direction, radians / time
  friend bool operator==(const ClampConfig&, const ClampConfig&) = default;
};

/// A wave of preferred curvature in a tube, through the lengths at rest of the springs between its sections:
/// curvature envelope rise(t / ramp) cos(2 pi s / wavelength - angular_frequency t + phase), s being the arclength from
/// the first section. Waves of one fiber are added.
struct UndulationConfig {
  int fiber = 0;
  double curvature = 0.0;                                      ///< 1 / length
  double wavelength = 0.0;                                     ///< length; 0: the same phase everywhere
  double angular_frequency = 0.0;                              ///< radians / time
  double phase = 0.0;                                          ///< degrees
  double plane = 0.0;                                          ///< degrees about the fiber from node 0 of a section
  double ramp = 0.0;                                           ///< time in which it rises from t = 0 on
  std::vector<ProfilePoint> envelope{{0.0, 1.0}, {1.0, 1.0}};  ///< straight lines between the points
  friend bool operator==(const UndulationConfig&, const UndulationConfig&) = default;
};

/// What maps the scene onto itself, and keeps doing so: a plane or an axis through the origin.
struct SymmetryConfig {
  SymmetryAxis mirror = SymmetryAxis::none;     ///< normal of the plane
  SymmetryAxis half_turn = SymmetryAxis::none;  ///< axis of a turn by 180 degrees

  bool is_none() const { return mirror == SymmetryAxis::none && half_turn == SymmetryAxis::none; }
  friend bool operator==(const SymmetryConfig&, const SymmetryConfig&) = default;
};

struct HydrodynamicsConfig {
  SumMethod method = SumMethod::automatic;
  Precision precision = Precision::automatic;  ///< arithmetic of a pair
  /// Of velocities, relative (2-norm), where they are not summed directly; 0: see find_sum_tolerance.
  double tolerance = 0.0;
  FarField far_field = FarField::harmonic;
  int order = 0;         ///< points per edge of the surfaces; 0: as the tolerance needs
  int leaf_size = 0;     ///< nodes per leaf of the tree; 0: as the order needs
  int check_every = 50;  ///< evaluations from check to check; 0: no checks
  OnMiss on_miss = OnMiss::raise_order;
  friend bool operator==(const HydrodynamicsConfig&, const HydrodynamicsConfig&) = default;
};

/// Zeros stand for what goes with the scene's own time, whatever its units; see resolve_times.
struct TimeConfig {
  TimeMethod method = TimeMethod::rkc2;
  double end = 12.0;                 ///< time
  double step = 0.0;                 ///< time; 0 lets the error control choose; euler needs one
  double tolerance = 0.0;            ///< error per unit time, as a fraction of the longest fiber's length, 1 / time
  double max_step = 0.0;             ///< time; may be infinite
  double start = 0.0;                ///< time
  std::vector<double> earlier_ends;  ///< growing, below the end: where the run ended before it was prolonged
  friend bool operator==(const TimeConfig&, const TimeConfig&) = default;
};

/// Another run's state, with which a run begins in place of the fibers as written; its time is time.start. The
/// positions are in a file beside the scene (io/start_file).
struct StartConfig {
  std::string checksum;     ///< of that file; empty: the run begins with the fibers as written
  std::string parent;       ///< the run's folder, as it was named
  std::string certificate;  ///< end of its chain of checksums
  std::int64_t step = 0;    ///< accepted steps of that run up to this state
  friend bool operator==(const StartConfig&, const StartConfig&) = default;
};

struct OutputConfig {
  double frame_interval = 0.0;                 ///< time between frames; 0 as in TimeConfig
  Precision precision = Precision::in_double;  ///< of positions in frames; never automatic
  friend bool operator==(const OutputConfig&, const OutputConfig&) = default;
};

struct CheckpointConfig {
  double wall_interval = 300.0;     ///< seconds of wall time; 0: none by the clock
  double simulated_interval = 0.0;  ///< time; 0: none by simulated time
  int keep = 3;                     ///< newest ones
  friend bool operator==(const CheckpointConfig&, const CheckpointConfig&) = default;
};

struct SceneConfig {
  std::string title;
  std::uint64_t seed = 1;
  FluidConfig fluid;
  std::vector<FlowConfig> flows{FlowConfig{}};
  std::vector<FiberConfig> fibers;
  PlacementConfig placement;
  RepulsionConfig repulsion;
  GravityConfig gravity;
  std::vector<TetherConfig> tethers;
  std::vector<TorqueConfig> torques;
  std::vector<UndulationConfig> undulations;
  std::vector<ClampConfig> clamps;
  SymmetryConfig symmetry;
  HydrodynamicsConfig hydrodynamics;
  TimeConfig time;
  OutputConfig output;
  CheckpointConfig checkpoint;
  StartConfig start;
  friend bool operator==(const SceneConfig&, const SceneConfig&) = default;
};

}  // namespace skein
