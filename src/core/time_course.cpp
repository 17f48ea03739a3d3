#include <skein/core/time_course.hpp>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_roundings = 64.0;  // of the time, in a step

}  // namespace

void TimeCourse::add_piece(const double begin, const double end, const double longest_step) {
  if (!(end > begin)) return;
  if (begin > 0.0) breaks_.insert(begin);
  if (end < infinity) breaks_.insert(end);
  if (longest_step < infinity) pieces_.push_back({begin, end, longest_step});
}

void TimeCourse::add_oscillation(const double begin, const double end, const double period) {
  add_piece(begin, end, period / steps_per_period);
}

double TimeCourse::next_break(const double time) const {
  const auto next = breaks_.upper_bound(time);
  return next == breaks_.end() ? infinity : *next;
}

double TimeCourse::longest_step(const double time) const {
  double longest = infinity;
  for (const Piece& piece : pieces_)
    if (time >= piece.begin && time < piece.end) longest = std::min(longest, piece.longest_step);
  return std::max(longest, least_roundings * (std::nextafter(time, infinity) - time));
}

}  // namespace skein
