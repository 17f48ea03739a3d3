#pragma once

#include <skein/scene/scene_config.hpp>

#include <cstdint>

namespace skein {

/// When a frame is due: frame 0 at the start, then at each interval, the last one at the end. An interval that only
/// rounding keeps from the end leads to it, in every unit of time.
inline double find_frame_time(const SceneConfig& scene, const std::int64_t frame) {
  const double interval = scene.output.frame_interval, end = scene.time.end;
  const double time = static_cast<double>(frame) * interval;
  return time < end - 1e-9 * interval ? time : end;
}

}  // namespace skein
