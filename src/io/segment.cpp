#include "segment.hpp"

#include <skein/io/read_file.hpp>
#include <skein/scene/earlier_ends.hpp>

#include "moments.hpp"

#include <fmt/format.h>

#include <limits>

namespace skein {
namespace {

std::string read_checksum(const Hdf5Reader& file, const std::string& name) {
  std::string text = file.text_attribute("/", name);
  if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    file.reject("/@" + name, "it is not 16 hexadecimal digits");
  return text;
}

}  // namespace

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
  return read_segment_label(Hdf5Reader(folder.path() / segment_name(number), check_seal));
}

SegmentLabel read_segment_label(const Hdf5Reader& file) {
  SegmentLabel label;
  label.segment.number = file.integer_attribute("/", "number");
  label.segment.first_frame = file.integer_attribute("/", "first_frame");
  label.segment.first_record = file.integer_attribute("/", "first_record");
  label.segment.checksum = read_checksum(file, "xxh3");
  label.previous_checksum = read_checksum(file, "previous_xxh3");
  label.frames = read_moments(file, "/particles/fibers/position");
  label.records = read_moments(file, "/observables/energy");
  label.segment.n_frames = static_cast<std::int64_t>(label.frames.n_rows());
  label.segment.n_records = static_cast<std::int64_t>(label.records.n_rows());
  label.segment.last_time =
      label.frames.time.empty() ? std::numeric_limits<double>::quiet_NaN() : label.frames.time.back();
  return label;
}

std::string checksum_of_first_scene(const RunFolder& folder) {
  Checksum checksum;
  checksum.add(find_first_scene_text(read_file(folder.scene())));
  return checksum.text();
}

}  // namespace skein
