#pragma once

#include <skein/io/run_folder.hpp>

#include "segment.hpp"
#include "series.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// What a check of a run needs of a segment's arrays.
struct SegmentMoments {
  SegmentLabel label;
  std::string checksum;  ///< computed anew from the arrays; equals label.segment.checksum where nothing was changed
  std::vector<double> record_dt;
};

/// Reads a segment wholly. @param frames, records  say which arrays belong to it
/// @throws Error(damaged_data) naming the file and what cannot be read
SegmentMoments read_segment_moments(const RunFolder& folder, std::int64_t number, const Series& frames,
                                    const Series& records);

}  // namespace skein
