#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/start_check.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/start_file.hpp>
#include <skein/io/start_name.hpp>

#include "checksum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace skein {
namespace {

std::vector<Vec3> take_positions(const Checkpoint& start, const SceneConfig& scene) {
  if (start.number("state.time") != scene.time.start)
    throw Error(ExitCode::damaged_data, fmt::format("it is of t = {}, and the scene's time.start is {}",
                                                    start.number("state.time"), scene.time.start));
  const std::vector<double>& numbers = start.numbers("state.position");
  const auto n_nodes = static_cast<std::size_t>(count_nodes(make_fibers(scene.fibers)));
  if (numbers.size() != 3 * n_nodes)
    throw Error(ExitCode::damaged_data,
                fmt::format("it has {} numbers for the positions of {} nodes", numbers.size(), n_nodes));
  if (!std::all_of(numbers.begin(), numbers.end(), [](const double x) { return std::isfinite(x); }))
    throw Error(ExitCode::damaged_data, "not all of its positions are finite");
  std::vector<Vec3> position;
  position.reserve(n_nodes);
  for (std::size_t i = 0; i < numbers.size(); i += 3) position.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return position;
}

/// The state of fibers that were elastic is no start of rigid ones.
void check_rigid_fibers(const SceneConfig& scene, const std::vector<Vec3>& position) {
  constexpr double largest_bend = 1e-4;  // of the length
  for (const Fiber& fiber : make_fibers(scene.fibers)) {
    if (!fiber.config.is_rigid()) continue;
    const double bend = measure_bend(fiber, std::span(position).subspan(fiber.first_node, fiber.n_nodes()));
    if (bend > largest_bend * fiber.length())
      throw Error(ExitCode::scene_error,
                  fmt::format("fiber {} is rigid here, and bent by {:.3g} there: begin where it is straight, or take "
                              "model = \"chain\"",
                              fiber.index, bend));
  }
}

}  // namespace

std::string encode_start(const std::vector<double>& position, const double time) {
  Checkpoint start;
  start.set("state.position", position);
  start.set("state.time", std::vector<double>{time});
  return encode_checkpoint(start);
}

std::string checksum_of_start(const std::string_view bytes) {
  Checksum checksum;
  checksum.add(bytes.data(), bytes.size());
  return checksum.text();
}

std::filesystem::path find_start(const std::filesystem::path& folder, const std::string_view checksum) {
  return folder / make_start_name(checksum);
}

std::vector<Vec3> decode_start(const std::string& bytes, const std::filesystem::path& file, const SceneConfig& scene) {
  try {
    if (const std::string found = checksum_of_start(bytes); found != scene.start.checksum)
      throw Error(ExitCode::damaged_data,
                  fmt::format("its xxh3 is {}, and the scene names {}", found, scene.start.checksum));
    std::vector<Vec3> position = take_positions(decode_checkpoint(bytes), scene);
    check_rigid_fibers(scene, position);
    return position;
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("'{}' is not the start of this scene: {}.", file.string(), error.what()));
  }
}

std::vector<Vec3> read_start(const std::filesystem::path& folder, const SceneConfig& scene) {
  const std::filesystem::path file = find_start(folder, scene.start.checksum);
  return decode_start(read_file(file), file, scene);
}

}  // namespace skein
