#include "segment.hpp"

#include <fmt/format.h>

namespace skein {

std::string segment_name(const std::int64_t number) { return fmt::format("segments/{:06}.h5", number); }

std::uint64_t write_segment(const RunFolder& folder, const Series& frames, const Series& records,
                            const std::string& previous_checksum, Segment& segment) {
  Checksum checksum;
  checksum.add(previous_checksum);
  frames.add_to(checksum);
  records.add_to(checksum);
  segment.checksum = checksum.text();
  segment.n_frames = static_cast<std::int64_t>(frames.n_rows());
  segment.n_records = static_cast<std::int64_t>(records.n_rows());
  if (segment.n_frames > 0) segment.last_time = frames.times().back();

  constexpr std::size_t overhead = 128 << 10;  // of HDF5's own structures
  Hdf5Writer file(folder.path() / segment_name(segment.number), frames.n_bytes() + records.n_bytes() + overhead);
  frames.write(file);
  records.write(file);
  frames.write_row_views(file, "/frames");
  file.set_attribute("/", "number", segment.number);
  file.set_attribute("/", "first_frame", segment.first_frame);
  file.set_attribute("/", "first_record", segment.first_record);
  file.set_attribute("/", "previous_xxh3", previous_checksum);
  file.set_attribute("/", "xxh3", segment.checksum);
  return file.commit();
}

}  // namespace skein
