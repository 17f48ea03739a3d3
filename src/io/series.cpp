#include "series.hpp"

#include <skein/core/error.hpp>

#include <fmt/format.h>

#include <cstring>

namespace skein {
namespace {

template <class Stored>
void store(const std::span<const double> row, std::byte* place) {
  for (const double value : row) {
    const Stored stored = static_cast<Stored>(value);
    std::memcpy(place, &stored, sizeof stored);
    place += sizeof stored;
  }
}

std::size_t count_values(const Shape& shape) {
  std::size_t n = 1;
  for (const hsize_t extent : shape) n *= extent;
  return n;
}

// The moments of all elements lie with the first.
void link_moments(Hdf5Writer& file, const std::vector<Series::Element>& elements) {
  for (std::size_t e = 1; e < elements.size(); ++e)
    for (const char* name : {"/step", "/time"}) file.link(elements[0].group + name, elements[e].group + name);
}

Number number_of(const Precision precision) {
  switch (precision) {
    case Precision::in_double:
      return Number::float64;
    case Precision::in_single:
      return Number::float32;
    case Precision::automatic:
      break;
  }
  throw Error(ExitCode::internal, "numbers in files are double or single: set output.precision to one of them");
}

static_assert(sizeof(Vec3) == 3 * sizeof(double));

std::span<const double> as_doubles(const std::vector<Vec3>& vectors) {
  return {vectors.empty() ? nullptr : &vectors.data()->x, 3 * vectors.size()};
}

}  // namespace

Shape Series::Element::shape(const hsize_t n_rows) const {
  Shape shape = {n_rows};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  return shape;
}

void Series::append(const std::int64_t step, const double time, const std::vector<std::span<const double>>& rows) {
  SKEIN_REQUIRE(rows.size() == elements_.size(), fmt::format("{}: one row for each element", name_));
  for (std::size_t e = 0; e < rows.size(); ++e)
    SKEIN_REQUIRE(rows[e].size() == count_values(elements_[e].row_shape),
                  fmt::format("{} of {} numbers appended to {}", name_, rows[e].size(), elements_[e].group));
  SKEIN_REQUIRE(
      !has_last_ || (time > last_time_ && step >= last_step_),
      fmt::format("{} at step {}, time {} appended after step {}, time {}", name_, step, time, last_step_, last_time_));
  for (std::size_t e = 0; e < rows.size(); ++e) {
    Element& element = elements_[e];
    const std::size_t filled = element.values.size();
    element.values.resize(filled + rows[e].size() * size_of(element.number));
    std::byte* place = element.values.data() + filled;
    switch (element.number) {
      case Number::float32:
        store<float>(rows[e], place);
        break;
      case Number::float64:
        store<double>(rows[e], place);
        break;
      case Number::int32:
        store<std::int32_t>(rows[e], place);
        break;
      case Number::int64:
        store<std::int64_t>(rows[e], place);
        break;
    }
  }
  step_.push_back(step);
  time_.push_back(time);
  set_last_moment(step, time);
}

void Series::set_last_moment(const std::int64_t step, const double time) {
  has_last_ = true;
  last_step_ = step;
  last_time_ = time;
}

void Series::clear() {
  step_.clear();
  time_.clear();
  for (Element& element : elements_) element.values.clear();
}

std::size_t Series::n_bytes() const {
  std::size_t n = n_rows() * (sizeof(std::int64_t) + sizeof(double));
  for (const Element& element : elements_) n += element.values.size();
  return n;
}

void Series::add_to(Checksum& checksum) const {
  checksum.add(step_.data(), step_.size() * sizeof(std::int64_t));
  checksum.add(time_.data(), time_.size() * sizeof(double));
  for (const Element& element : elements_) checksum.add(element.values.data(), element.values.size());
}

void Series::write(Hdf5Writer& file) const {
  const Shape moments = {n_rows()};
  file.write(elements_[0].group + "/step", Number::int64, moments, step_.data());
  file.write(elements_[0].group + "/time", Number::float64, moments, time_.data(), "time");
  for (const Element& element : elements_)
    file.write(element.group + "/value", element.number, element.shape(n_rows()), element.values.data(), element.unit);
  link_moments(file, elements_);
}

void Series::write_row_views(Hdf5Writer& file, const std::string& group) const {
  file.write_row_views(group, elements_[0].group + "/value", elements_[0].number, elements_[0].shape(n_rows()));
}

void Series::write_virtual(Hdf5Writer& file, const std::vector<Hdf5Writer::Source>& sources) const {
  file.write_virtual(elements_[0].group + "/step", Number::int64, {}, sources);
  file.write_virtual(elements_[0].group + "/time", Number::float64, {}, sources, "time");
  for (const Element& element : elements_)
    file.write_virtual(element.group + "/value", element.number, element.row_shape, sources, element.unit);
  link_moments(file, elements_);
}

Series make_frame_series(const TrajectoryLayout& layout, const OutputConfig& output) {
  const auto n_nodes = static_cast<hsize_t>(count_nodes(layout.fibers));
  const auto n_sections = static_cast<hsize_t>(count_sections(layout.fibers));
  const Number position = number_of(output.precision);
  return {"frame",
          {{"/particles/fibers/position", position, {n_nodes, 3}, "length"},
           {"/observables/centreline", Number::float64, {n_sections, 3}, "length"},
           {"/observables/curvature", Number::float64, {n_sections}, "1/length"}}};
}

void append(Series& series, const Frame& frame) {
  series.append(frame.step, frame.time, {as_doubles(frame.position), as_doubles(frame.centreline), frame.curvature});
}

Series make_step_series(const TrajectoryLayout& layout) {
  const hsize_t n_fibers = layout.fibers.size();
  return {"step record",
          {{"/observables/energy", Number::float64, {n_fibers}, "force*length"},
           {"/observables/centreline_length", Number::float64, {n_fibers}, "length"},
           {"/observables/curvature_max", Number::float64, {n_fibers}, "1/length"},
           {"/observables/symmetry_defect", Number::float64, {n_fibers}, ""},
           {"/observables/out_of_plane", Number::float64, {n_fibers}, "length"},
           {"/observables/end_to_end", Number::float64, {n_fibers, 3}, "length"},
           {"/observables/smallest_gap", Number::float64, {}, "length"},
           {"/observables/nodes_inside", Number::int64, {}, ""},
           {"/observables/depth", Number::float64, {}, "length"},
           {"/observables/crossings", Number::int64, {}, ""},
           {"/observables/dt", Number::float64, {}, "time"},
           {"/observables/error", Number::float64, {}, ""},
           {"/observables/estimated_error", Number::float64, {}, "length"},
           {"/observables/spectral_radius", Number::float64, {}, "1/time"},
           {"/observables/evaluations", Number::int64, {}, ""},
           {"/observables/velocity_error", Number::float64, {}, ""},
           {"/observables/fmm_order", Number::int32, {}, ""},
           {"/observables/fmm_misses", Number::int64, {}, ""}}};
}

void append(Series& series, const StepRecord& record) {
  const auto evaluations = static_cast<double>(record.evaluations);  // exact below 2^53
  const auto inside = static_cast<double>(record.nodes_inside), crossings = static_cast<double>(record.crossings);
  const auto order = static_cast<double>(record.fmm_order), misses = static_cast<double>(record.fmm_misses);
  const auto one = [](const double& value) { return std::span<const double>(&value, 1); };
  series.append(record.step, record.time,
                {record.energy, record.length, record.curvature_max, record.symmetry_defect, record.out_of_plane,
                 as_doubles(record.end_to_end), one(record.smallest_gap), one(inside), one(record.depth),
                 one(crossings), one(record.dt), one(record.error), one(record.estimated_error),
                 one(record.spectral_radius), one(evaluations), one(record.velocity_error), one(order), one(misses)});
}

}  // namespace skein
