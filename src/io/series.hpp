#pragma once

#include <skein/io/trajectory.hpp>
#include <skein/scene/scene_config.hpp>

#include "checksum.hpp"
#include "hdf5_writer.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace skein {

/// Time-dependent arrays that share their moments, row by row: H5MD elements. The first owns `step` and `time`, the
/// others link to them.
class Series {
 public:
  struct Element {
    std::string group;
    Number number;
    Shape row_shape;
    std::string unit;
    std::vector<std::byte> values = {};  ///< [n_rows, row_shape], as stored

    Shape shape(hsize_t n_rows) const;  ///< of so many rows
  };

  Series(const char* name, std::vector<Element> elements) : name_(name), elements_(std::move(elements)) {}

  /// Appends one row: a list of numbers for each element. Rows need growing times, also across clear().
  void append(std::int64_t step, double time, const std::vector<std::span<const double>>& rows);

  /// Forgets the rows, keeps the last moment.
  void clear();

  /// The last moment of rows that are on disk already.
  void set_last_moment(std::int64_t step, double time);

  std::size_t n_rows() const { return time_.size(); }
  std::size_t n_bytes() const;
  const std::vector<double>& times() const { return time_; }
  const std::vector<Element>& elements() const { return elements_; }

  /// Steps, times, then the values of each element, as they lie in the file.
  void add_to(Checksum& checksum) const;
  void write(Hdf5Writer& file) const;
  /// The rows of the first element as datasets of their own, `<group>/0`, ...
  void write_row_views(Hdf5Writer& file, const std::string& group) const;
  /// The same datasets in the index, as views of the segments.
  void write_virtual(Hdf5Writer& file, const std::vector<Hdf5Writer::Source>& sources) const;

 private:
  const char* name_;
  std::vector<Element> elements_;
  std::vector<std::int64_t> step_;
  std::vector<double> time_;
  bool has_last_ = false;
  std::int64_t last_step_ = 0;
  double last_time_ = 0.0;
};

/// position, centreline, curvature; `output` says how positions are stored.
Series make_frame_series(const TrajectoryLayout& layout, const OutputConfig& output);
void append(Series& series, const Frame& frame);

/// The small numbers of every accepted step.
Series make_step_series(const TrajectoryLayout& layout);
void append(Series& series, const StepRecord& record);

}  // namespace skein
