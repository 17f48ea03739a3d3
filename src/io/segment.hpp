#pragma once

#include <skein/io/run_folder.hpp>

#include "moments.hpp"
#include "series.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// One closed segment, as the index knows it.
struct Segment {
  std::int64_t number = 0;
  std::int64_t first_frame = 0;
  std::int64_t n_frames = 0;
  std::int64_t first_record = 0;
  std::int64_t n_records = 0;
  double last_time = 0.0;  ///< of the last frame so far
  std::string checksum;    ///< xxh3 of the previous segment's checksum and this one's contents, 16 hexadecimal digits
};

/// "segments/000012.h5": relative to the run folder.
std::string segment_name(std::int64_t number);

/// Writes what was buffered as one file that is never opened for writing again. It holds the time-dependent datasets
/// under the names they have in the index, the positions of each frame as /frames/0, ... once more (views, for XDMF),
/// and as attributes of its root: number, first_frame, first_record, xxh3, previous_xxh3. Behind HDF5's own end stands
/// the file's seal, see checksum.hpp. The chain starts with the xxh3 of scene.toml as it was first; each xxh3 is that
/// of the previous one's 16 digits, then for frames and for step records: step, time, and the value of every element in
/// the order of series.cpp, raw as stored.
///
/// @param segment  number, first_frame and first_record; the rest is filled in
/// @returns the bytes written
std::uint64_t write_segment(const RunFolder& folder, const Series& frames, const Series& records,
                            const std::string& previous_checksum, Segment& segment);

/// What a segment says of itself.
struct SegmentLabel {
  Segment segment;  ///< last_time: of its own frames, NaN without one
  std::string previous_checksum;
  Moments frames, records;
};

/// @throws Error(damaged_data) naming the file and what cannot be read
/// @param check_seal  see Hdf5Reader
SegmentLabel read_segment_label(const RunFolder& folder, std::int64_t number, bool check_seal);
SegmentLabel read_segment_label(const Hdf5Reader& file);

/// xxh3 of the scene's text with which the run began (see find_first_scene_text), 16 hexadecimal digits: where the
/// chain begins. A scene that was changed at any other place than its end has another one.
std::string checksum_of_first_scene(const RunFolder& folder);

}  // namespace skein
