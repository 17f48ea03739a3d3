#pragma once

#include <memory>
#include <skein/config/scene_config.hpp>
#include <skein/core/types.hpp>
#include <string>

namespace skein {

/// The flow far from all fibers. A new flow is a class of this interface and one line in make_background_flow.
class BackgroundFlow {
 public:
  virtual ~BackgroundFlow() = default;

  /// velocity += the flow at each position.
  /// @param position, velocity  [n, 3], length and length / time. Returns before a device has finished.
  /// @throws Error(internal) if the extents differ
  virtual void add_velocity(double time, const ConstVectors& position, const Vectors& velocity) const = 0;

  /// One line for the first lines of a run.
  virtual std::string describe() const = 0;
};

/// @throws Error(scene_error) for a kind that is not known
std::unique_ptr<BackgroundFlow> make_background_flow(const FlowConfig& config);

}  // namespace skein
