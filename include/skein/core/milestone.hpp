#pragma once

#include <functional>
#include <string_view>

namespace skein {

using MilestoneObserver = std::function<void(std::string_view name)>;

/// Says by name that a point is reached at which a process may end without loss: "step", "checkpoint.written", ... It
/// does nothing but call the observer, if there is one.
void pass_milestone(std::string_view name);

/// For tests of what a run survives: sees every milestone from now on. An empty one takes the observer away.
void observe_milestones(MilestoneObserver observer);

}  // namespace skein
