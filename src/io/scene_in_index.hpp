#pragma once

#include <skein/io/run_folder.hpp>

#include "hdf5_reader.hpp"

namespace skein {

/// See check_scene_is_of_run. @param index  of that folder
void compare_with_scene_in_index(const RunFolder& folder, const Hdf5Reader& index);

}  // namespace skein
