#pragma once

#include "hdf5_reader.hpp"
#include "segment.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// The checksums of all segments one after the other, 16 digits each: what an index lists.
std::string list_checksums(const std::vector<Segment>& segments);

/// A segment's checksum stands for all frames and steps up to its end, beginning with the scene, so that one of another
/// run, or of another part of this run, is not taken for the one that is listed.
/// @param segment  number `number`, open at `path`
/// @param chain    see list_checksums; empty in runs of older versions, whose segments are not compared
/// @throws Error(damaged_data) if it is not the one that is listed
void check_is_listed(const Hdf5Reader& segment, const std::filesystem::path& path, std::int64_t number,
                     const std::string& chain);

}  // namespace skein
