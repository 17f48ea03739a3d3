#pragma once

#include <skein/core/time_course.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>

#include <vector>

namespace skein {

// Times in which what acts on fibers carries one of them by its length, or turns it around: estimates, with the drag
// of a slender rod, that go with the units of time and length. Infinite where nothing moves; the shortest of all
// fibers.

double find_falling_time(double weight, const std::vector<Fiber>& fibers, double viscosity);

/// Of tethers whose points move; those that stand still only hold.
double find_tether_time(const std::vector<TetherConfig>& tethers, const std::vector<Fiber>& fibers);

double find_torque_time(const std::vector<TorqueConfig>& torques, const std::vector<Fiber>& fibers, double viscosity);

/// Of clamps whose frames move: a period, where they tilt or spin.
double find_clamp_time(const std::vector<ClampConfig>& clamps, const std::vector<Fiber>& fibers);

/// Of waves that travel or beat: a period.
double find_undulation_time(const std::vector<UndulationConfig>& undulations);

/// What oscillates from t = 0 on, for ever. @param angular_frequency  radians / time, of either sign; 0 adds nothing
void add_endless_oscillation(TimeCourse& course, double angular_frequency);

/// In which the slowest bend of a free fiber relaxes.
double find_relaxation_time(const std::vector<Fiber>& fibers, double viscosity);

}  // namespace skein
