#include "segment.hpp"

#include <skein/io/atomic_file.hpp>

#include "hdf5_reader.hpp"

#include <fmt/format.h>

#include <limits>

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

SegmentLabel read_segment_label(const RunFolder& folder, const std::int64_t number, const bool check_seal) {
  const Hdf5Reader file(folder.path() / segment_name(number), check_seal);
  SegmentLabel label;
  label.segment.number = file.integer_attribute("/", "number");
  label.segment.first_frame = file.integer_attribute("/", "first_frame");
  label.segment.first_record = file.integer_attribute("/", "first_record");
  label.segment.checksum = file.text_attribute("/", "xxh3");
  label.previous_checksum = file.text_attribute("/", "previous_xxh3");
  label.frame_times = file.read_reals("/particles/fibers/position/time");
  const auto frame_steps = file.read_integers("/particles/fibers/position/step");
  const auto record_times = file.read_reals("/observables/energy/time");
  const auto record_steps = file.read_integers("/observables/energy/step");
  label.segment.n_frames = static_cast<std::int64_t>(label.frame_times.size());
  label.segment.n_records = static_cast<std::int64_t>(record_times.size());
  label.segment.last_time =
      label.frame_times.empty() ? std::numeric_limits<double>::quiet_NaN() : label.frame_times.back();
  if (!frame_steps.empty()) label.last_frame_step = frame_steps.back();
  if (!record_steps.empty()) label.last_record_step = record_steps.back();
  if (!record_times.empty()) label.last_record_time = record_times.back();
  return label;
}

std::string checksum_of_file(const std::filesystem::path& path) {
  Checksum checksum;
  checksum.add(read_file(path));
  return checksum.text();
}

}  // namespace skein
