#include "segment_check.hpp"

#include "hdf5_reader.hpp"

namespace skein {
namespace {

void add_to(Checksum& checksum, const Hdf5Reader& file, const std::string& dataset, const Number number,
            const Shape& shape) {
  const auto values = file.read_raw(dataset, number, shape);
  checksum.add(values.data(), values.size());
}

// The order in which Series::add_to goes.
void add_series(Checksum& checksum, const Hdf5Reader& file, const Series& series, const hsize_t n_rows) {
  const std::string first = series.elements().front().group;
  add_to(checksum, file, first + "/step", Number::int64, {n_rows});
  add_to(checksum, file, first + "/time", Number::float64, {n_rows});
  for (const Series::Element& element : series.elements())
    add_to(checksum, file, element.group + "/value", element.number, element.shape(n_rows));
}

}  // namespace

SegmentMoments read_segment_moments(const RunFolder& folder, const std::int64_t number, const Series& frames,
                                    const Series& records) {
  const Hdf5Reader file(folder.path() / segment_name(number));
  SegmentMoments moments;
  moments.label = read_segment_label(file);
  Checksum checksum;
  checksum.add(moments.label.previous_checksum);
  add_series(checksum, file, frames, moments.label.frames.n_rows());
  add_series(checksum, file, records, moments.label.records.n_rows());
  moments.checksum = checksum.text();
  moments.record_dt = file.read_reals("/observables/dt/value", {moments.label.records.n_rows()});
  return moments;
}

}  // namespace skein
