#include <skein/scene/profile.hpp>

#include <algorithm>

namespace skein {

double interpolate(const std::vector<ProfilePoint>& profile, const double position) {
  const auto after = std::find_if(profile.begin(), profile.end(),
                                  [position](const ProfilePoint& point) { return point.position >= position; });
  if (after == profile.begin()) return profile.front().factor;
  if (after == profile.end()) return profile.back().factor;
  const ProfilePoint& before = *(after - 1);
  const double share = (position - before.position) / (after->position - before.position);
  return before.factor + share * (after->factor - before.factor);
}

}  // namespace skein
