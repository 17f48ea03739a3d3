#include "segment_list.hpp"

#include "segment_chain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace skein {
namespace {

constexpr const char* frames_name = "/parameters/segments/frames";
constexpr const char* steps_name = "/parameters/segments/steps";
constexpr const char* last_time_name = "/parameters/segments/last_time";

// No run has as many frames or steps; their sum stays far from overflow.
constexpr std::int64_t largest_count = std::int64_t{1} << 40;

std::vector<std::int64_t> read_counts(const Hdf5Reader& index, const std::string& dataset, const hsize_t n_segments) {
  auto counts = index.read_integers(dataset, {n_segments});
  for (const std::int64_t count : counts)
    if (count < 0 || count > largest_count) index.reject(dataset, fmt::format("a segment cannot have {}", count));
  return counts;
}

}  // namespace

void write_segment_list(Hdf5Writer& index, const std::vector<Segment>& segments) {
  SegmentList list;
  for (const Segment& segment : segments) {
    list.frames.push_back(segment.n_frames);
    list.steps.push_back(segment.n_records);
    list.last_time.push_back(segment.last_time);
  }
  const Shape shape = {segments.size()};
  index.write(frames_name, Number::int64, shape, list.frames.data());
  index.write(steps_name, Number::int64, shape, list.steps.data());
  index.write(last_time_name, Number::float64, shape, list.last_time.data(), "time");
  if (!segments.empty()) index.set_attribute("/parameters/segments", "xxh3", segments.back().checksum);
  index.set_attribute("/parameters/segments", "chain", list_checksums(segments));
}

SegmentList read_segment_list(const Hdf5Reader& index) {
  SegmentList list;
  list.frames = read_counts(index, frames_name, any_extent);
  list.steps = read_counts(index, steps_name, list.frames.size());
  list.last_time = index.read_reals(last_time_name, {list.frames.size()}, Values::any);
  std::int64_t n_frames = 0;
  for (std::size_t i = 0; i < list.frames.size(); ++i) {
    n_frames += list.frames[i];
    const bool grows = n_frames == list.frames[i] || !(list.last_time[i] < list.last_time[i - 1]);
    if (n_frames > 0 && !(std::isfinite(list.last_time[i]) && grows))
      index.reject(last_time_name, fmt::format("the frames up to segment {} end at {}", i, list.last_time[i]));
  }
  return list;
}

}  // namespace skein
