#include <skein/core/milestone.hpp>

#include <utility>

namespace skein {
namespace {

MilestoneObserver& the_observer() {
  static MilestoneObserver observer;
  return observer;
}

}  // namespace

void pass_milestone(const std::string_view name) {
  if (const MilestoneObserver& observer = the_observer()) observer(name);
}

void observe_milestones(MilestoneObserver observer) { the_observer() = std::move(observer); }

}  // namespace skein
