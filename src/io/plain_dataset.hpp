#pragma once

#include "hdf5_handle.hpp"

#include <cstddef>
#include <limits>
#include <string>

namespace skein {

/// Stands in an expected shape for an extent that only the file knows.
inline constexpr hsize_t any_extent = std::numeric_limits<hsize_t>::max();

/// "5 x 12 x 3"; any_extent is n.
std::string describe_shape(const Shape& shape);

/// Extents of a simple or scalar data space. @returns false where it is of another kind
bool read_shape(hid_t space, Shape& shape);

/// What a dataset holds that is as this program writes it: in one piece inside the file, with one of the types of
/// Number. Chunks, filters, virtual datasets and files elsewhere are faults, and so is an extent that the file's bytes
/// cannot fill: reading such a dataset would run whatever the file asks for.
struct PlainDataset {
  std::size_t n_values = 0;
  Number number = Number::float64;
};

/// @param expected  with any_extent where an extent is open
/// @returns what is wrong with an open object, empty if nothing is and `found` was set
std::string find_dataset_fault(hid_t file, hid_t object, const Shape& expected, PlainDataset& found);

}  // namespace skein
