#include "segment_check.hpp"

#include "hdf5_reader.hpp"

namespace skein {
namespace {

void add_to(Checksum& checksum, const Hdf5Reader& file, const std::string& dataset, const Number number) {
  const auto values = file.read_raw(dataset, number);
  checksum.add(values.data(), values.size());
}

// The order in which Series::add_to goes.
void add_series(Checksum& checksum, const Hdf5Reader& file, const Series& series) {
  const std::string first = series.elements().front().group;
  add_to(checksum, file, first + "/step", Number::int64);
  add_to(checksum, file, first + "/time", Number::float64);
  for (const Series::Element& element : series.elements())
    add_to(checksum, file, element.group + "/value", element.number);
}

}  // namespace

SegmentMoments read_segment_moments(const RunFolder& folder, const std::int64_t number, const Series& frames,
                                    const Series& records) {
  SegmentMoments moments;
  moments.label = read_segment_label(folder, number);
  const Hdf5Reader file(folder.path() / segment_name(number));
  Checksum checksum;
  checksum.add(moments.label.previous_checksum);
  add_series(checksum, file, frames);
  add_series(checksum, file, records);
  moments.checksum = checksum.text();
  moments.frame_steps = file.read_integers("/particles/fibers/position/step");
  moments.record_steps = file.read_integers("/observables/energy/step");
  moments.record_times = file.read_reals("/observables/energy/time");
  moments.record_dt = file.read_reals("/observables/dt/value");
  return moments;
}

}  // namespace skein
