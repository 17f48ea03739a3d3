#pragma once

#include <skein/core/vec3.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/scene/scene_config.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

// The file of a run that begins with another one's state: in a checkpoint's format, so that it is sealed and exact, and
// never removed. The scene names its checksum, so that the chain of checksums covers it. So does the file's name: where
// a run replaces another one, each scene has its own start, whichever of the two is there.

/// @param position  numbers of all nodes in order, [3 n_nodes], length
/// @returns the bytes of the file
std::string encode_start(const std::vector<double>& position, double time);

/// xxh3 of the file, 16 hexadecimal digits: what StartConfig holds.
std::string checksum_of_start(std::string_view bytes);

/// Where the start with this checksum lies: start-CHECKSUM.checkpoint beside the scene.
std::filesystem::path find_start(const std::filesystem::path& folder, std::string_view checksum);

/// @param file  for messages
/// @returns [n_nodes], length
/// @throws Error(damaged_data) if these are not the bytes that the scene names, or do not fit its nodes and start;
///         Error(scene_error) if a fiber is bent that is rigid in the scene
std::vector<Vec3> decode_start(const std::string& bytes, const std::filesystem::path& file, const SceneConfig& scene);

/// The same of the scene's file in a folder. @throws Error(missing_input), Error(io_error), too, if it is not there or
/// cannot be read
std::vector<Vec3> read_start(const std::filesystem::path& folder, const SceneConfig& scene);

}  // namespace skein
