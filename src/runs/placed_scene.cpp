#include "runs/placed_scene.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/placement.hpp>
#include <skein/fibers/start_check.hpp>
#include <skein/physics/chain.hpp>
#include <skein/physics/mobility_choice.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/physics/symmetry_check.hpp>
#include <skein/scene/fiber_spacing.hpp>

#include "runs/memory_limit.hpp"

#include <functional>
#include <utility>

namespace skein {

namespace {

std::vector<KeyProblem> find_problems(const SceneConfig& scene) {
  const SceneConfig laid_out = lay_out_chains(scene);
  auto problems = find_mobility_problems(laid_out);
  const auto starts = find_start_problems(laid_out);
  problems.insert(problems.end(), starts.begin(), starts.end());
  return problems;
}

/// @param name  of the scene, for messages
/// @param read  reads it, with a check of its own
PlacedScene place_scene(const std::string& name, const std::function<SceneReading(const SceneCheck&)>& read) {
  SceneReading reading = read(find_problems);
  check_memory(lay_out_chains(reading.config));
  try {
    SceneConfig placed = place_fibers(resolve_chains(reading.config));
    // They are only known once fibers are placed, and only the file knows where their keys stand.
    auto problems = find_time_problems(placed);
    const auto broken = find_symmetry_problems(placed);
    problems.insert(problems.end(), broken.begin(), broken.end());
    if (!problems.empty()) read([&](const SceneConfig&) { return problems; });
    reading.config = resolve_times(std::move(placed));
    check_overlap(make_fibers(reading.config.fibers), reading.config.seed);
    std::string text = write_readable_scene(reading.config);
    return {std::move(reading.config), std::move(reading.warnings), std::move(text)};
  } catch (const SceneError&) {
    throw;
  } catch (const Error& error) {
    if (error.code() != ExitCode::scene_error) throw;
    throw SceneError(name, {Problem{{name, 0, 0, -1}, error.what(), ""}});
  }
}

}  // namespace

PlacedScene read_placed_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return place_scene(file.string(), [&](const SceneCheck& check) { return read_scene(file, overrides, check); });
}

PlacedScene read_placed_scene_text(const std::string& text, const std::string& name,
                                   const std::vector<std::string>& overrides) {
  return place_scene(name, [&](const SceneCheck& check) { return read_scene_text(text, name, overrides, check); });
}

}  // namespace skein
