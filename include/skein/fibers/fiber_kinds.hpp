#pragma once

#include <skein/scene/scene_config.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace skein {

/// The fiber at the place of another, which starts as that one does.
FiberConfig put_in_place_of(FiberConfig fiber, const FiberConfig& other);

/// What is made of fibers, once for all that are alike but for place and start: scenes often have many of one kind.
class FiberKinds {
 public:
  /// @param make  of a fiber without place and start; what it makes gets these of the fiber that is asked for
  explicit FiberKinds(std::function<FiberConfig(const FiberConfig&)> make) : make_(std::move(make)) {}

  FiberConfig find(const FiberConfig& fiber);

 private:
  std::function<FiberConfig(const FiberConfig&)> make_;
  std::vector<std::pair<FiberConfig, FiberConfig>> known_;
};

}  // namespace skein
