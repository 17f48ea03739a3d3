#include "mpi/rank_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skein {

PulseBook::PulseBook(const std::vector<int>& watched, const double now)
    : watched_(watched), last_(watched.size(), now), last_look_(now) {}

void PulseBook::hear(const int rank, const double now) {
  const auto found = std::find(watched_.begin(), watched_.end(), rank);
  if (found != watched_.end()) last_[static_cast<std::size_t>(found - watched_.begin())] = now;
}

int PulseBook::look(const double now) {
  if (now - last_look_ > longest_own_gap) std::fill(last_.begin(), last_.end(), now);
  last_look_ = now;
  for (std::size_t i = 0; i < watched_.size(); ++i)
    if (now - last_[i] > longest_silence) return watched_[i];
  return -1;
}

std::string WorkWatch::look(const double now, const double work_since, const double longest_work,
                            const double processor_time) {
  const bool was_stopped = now - last_look_ > PulseBook::longest_own_gap;
  last_look_ = now;
  const bool computes = processor_time - processor_time_ > least_share * (now - idle_since_);
  if (was_stopped || work_since < 0.0 || work_since != work_since_ || computes) {
    idle_since_ = now;
    processor_time_ = processor_time;
  }
  if (was_stopped) return {};
  work_since_ = work_since;
  if (work_since < 0.0) return {};
  if (now - idle_since_ > longest_idling)
    return fmt::format("does nothing for {:.0f} s in the middle of a sum", now - idle_since_);
  if (longest_work > 0.0 && now - work_since > spare + times_longest * longest_work)
    return fmt::format("comes to no end of its part of a sum: {:.0f} s, where {:.2g} s were the longest before",
                       now - work_since, longest_work);
  return {};
}

}  // namespace skein
