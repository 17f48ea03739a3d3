#pragma once

#include "hdf5_handle.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// An HDF5 file built in memory and put on disk whole by commit(): the disk is touched in one place only, whose errors
/// name the bytes, and HDF5's file locks, which some file systems refuse, are never taken.
///
/// Names of objects are absolute; missing groups are made on the way.
/// @throws Error(io_error) from every function, naming the file and the object
class Hdf5Writer {
 public:
  /// @param growth  bytes by which the image in memory grows; about the size of the file to come
  Hdf5Writer(std::filesystem::path path, std::size_t growth);

  void make_group(const std::string& group);

  /// @param unit  no attribute is made for an empty one
  void write(const std::string& dataset, Number number, const Shape& shape, const void* values,
             const std::string& unit = "");

  /// Rows of another file's dataset that has the same name.
  struct Source {
    std::string file;  ///< relative to the folder of this file
    hsize_t n_rows;
  };
  /// One dataset out of those of several files, row after row. Where a file is missing readers find NaN, or -1.
  void write_virtual(const std::string& dataset, Number number, const Shape& row_shape,
                     const std::vector<Source>& sources, const std::string& unit = "");

  /// Each row of a dataset of this file once more, as a dataset of its own: `<group>/<row>`, views without numbers.
  void write_row_views(const std::string& group, const std::string& dataset, Number number, const Shape& shape);

  void link(const std::string& existing, const std::string& name);

  void set_attribute(const std::string& object, const std::string& name, const std::string& text);
  void set_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& texts);
  void set_attribute(const std::string& object, const std::string& name, const std::vector<std::int64_t>& values);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_reference(const std::string& object, const std::string& name, const std::string& target);

  /// @returns the bytes written
  std::uint64_t commit();

 private:
  template <class Result>
  Result checked(Result result, const char* what, const std::string& object) const;
  template <class Result>
  Hdf5Handle handle(Result result, Hdf5Handle::Close close, const char* what, const std::string& object) const;
  Hdf5Handle make_creation(const std::string& dataset) const;
  Hdf5Handle make_virtual_creation(Number number, const std::string& dataset) const;
  void write_attribute(const std::string& object, const std::string& name, hid_t type, const Hdf5Handle& space,
                       const void* value);

  QuietHdf5 quiet_;
  std::filesystem::path path_;
  Hdf5Handle file_;
  Hdf5Handle make_groups_;  // property list of links
};

}  // namespace skein
