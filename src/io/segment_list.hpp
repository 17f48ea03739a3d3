#pragma once

#include "hdf5_reader.hpp"
#include "hdf5_writer.hpp"
#include "segment.hpp"

#include <cstdint>
#include <vector>

namespace skein {

/// What the index says of every segment: /parameters/segments. [n_segments] each
struct SegmentList {
  std::vector<std::int64_t> frames, steps;
  std::vector<double> last_time;  ///< of the last frame so far; NaN before the first

  std::int64_t size() const { return static_cast<std::int64_t>(frames.size()); }
};

void write_segment_list(Hdf5Writer& index, const std::vector<Segment>& segments);

/// @throws Error(damaged_data) naming the list that does not fit the others, or holds what cannot be
SegmentList read_segment_list(const Hdf5Reader& index);

}  // namespace skein
