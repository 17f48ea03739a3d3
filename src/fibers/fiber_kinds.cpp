#include <skein/fibers/fiber_kinds.hpp>

#include <algorithm>

namespace skein {

FiberConfig put_in_place_of(FiberConfig fiber, const FiberConfig& other) {
  fiber.center = other.center;
  fiber.direction = other.direction;
  fiber.roll = other.roll;
  fiber.start_mode = other.start_mode;
  fiber.start_amplitude = other.start_amplitude;
  fiber.start_plane = other.start_plane;
  fiber.start_noise = other.start_noise;
  return fiber;
}

FiberConfig FiberKinds::find(const FiberConfig& fiber) {
  const FiberConfig kind = put_in_place_of(fiber, FiberConfig{});
  auto found = std::find_if(known_.begin(), known_.end(), [&](const auto& pair) { return pair.first == kind; });
  if (found == known_.end()) found = known_.insert(known_.end(), {kind, make_(kind)});
  return put_in_place_of(found->second, fiber);
}

}  // namespace skein
