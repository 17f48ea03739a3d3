#pragma once

#include <skein/core/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

// What a scene says, as plain structs with the defaults that `skein defaults` prints. Units are those of the scene:
// length, time, and force = viscosity * length^2 / time. Each key's meaning, unit and range stand where it is read
// (src/config/scene_keys.cpp), once.

struct FluidConfig {
  double viscosity = 1.0;  ///< > 0, force * time / length^2
};

struct FlowConfig {
  std::string kind = "shear";  ///< "shear": u = (rate y, 0, 0); "none"
  double rate = 2.5;           ///< 1 / time
};

/// One tube of surface nodes, straight at rest; several instances make several fibers.
struct FiberConfig {
  int sections = 80;                 ///< N_f, >= 2
  int nodes_per_section = 18;        ///< N_c, >= 3
  double radius = 0.005;             ///< R, length
  double spring_stiffness = 0.0112;  ///< k, force
  double blob = 0.00225;             ///< regularization length eps of this fiber's nodes
  Vec3 center{0.0, 0.0, 0.0};        ///< length
  Vec3 direction{1.0, 0.0, 0.0};     ///< any length but zero
  double roll = 0.0;                 ///< degrees, about the direction
};

struct HydrodynamicsConfig {
  std::string method = "direct";     ///< "direct"
  std::string precision = "double";  ///< "double", "single": arithmetic of a pair
};

struct TimeConfig {
  std::string method = "rkc2";  ///< "auto", "rkc2", "trbdf2", "rk4", "bs3", "euler"
  double end = 12.0;            ///< time
  double step = 0.0;            ///< time; 0 lets the error control choose; euler needs one
  double tolerance = 1e-4;      ///< error per unit time, as a fraction of the longest fiber's length
  double max_step = 0.1;        ///< time
};

struct OutputConfig {
  double frame_interval = 0.05;      ///< time between frames
  std::string precision = "double";  ///< "double", "single": positions in frames
};

struct CheckpointConfig {
  double wall_interval = 300.0;     ///< seconds of wall time; 0: none by the clock
  double simulated_interval = 0.0;  ///< time; 0: none by simulated time
  int keep = 3;                     ///< newest ones
};

struct SceneConfig {
  std::string title;
  std::uint64_t seed = 1;
  FluidConfig fluid;
  FlowConfig flow;
  std::vector<FiberConfig> fibers;
  HydrodynamicsConfig hydrodynamics;
  TimeConfig time;
  OutputConfig output;
  CheckpointConfig checkpoint;
};

}  // namespace skein
