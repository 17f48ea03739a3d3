#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

// Which times a run records exactly, as functions of the time alone: runs that were interrupted, prolonged or checked
// need remember nothing of them.

/// The first time after this one at which the run ends or once ended, where a step has to end; infinite after the end.
double find_next_end(const TimeConfig& time, double after);

/// The time of the first frame after this time, which is the start or later: a multiple of the interval, an earlier end
/// or the end; infinite after the end.
double find_next_frame(const SceneConfig& scene, double after);

/// Whether there is a frame at this time.
bool is_frame_time(const SceneConfig& scene, double time);

}  // namespace skein
