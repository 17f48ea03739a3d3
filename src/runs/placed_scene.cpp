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
#include <string>
#include <utility>
#include <vector>

namespace skein {

namespace {

std::vector<KeyProblem> find_problems(const SceneConfig& scene) {
  const SceneConfig laid_out = lay_out_chains(scene);
  auto problems = find_mobility_problems(laid_out);
  const auto starts = find_start_problems(laid_out);
  problems.insert(problems.end(), starts.begin(), starts.end());
  return problems;
}

std::vector<KeyProblem> find_problems_of_placed(const SceneConfig& scene, const SceneConfig& placed) {
  auto problems = find_time_problems(placed);
  for (const auto& found : {find_mobility_problems(placed), find_symmetry_problems(placed),
                            find_overlap_problems(scene, make_fibers(placed.fibers))})
    problems.insert(problems.end(), found.begin(), found.end());
  return problems;
}

using Reject = std::function<void(const std::vector<KeyProblem>&)>;

SceneConfig place(const SceneConfig& scene, const Reject& reject) {
  try {
    return place_fibers(scene);
  } catch (const Error& error) {
    if (error.code() == ExitCode::scene_error) reject({{"placement.count", error.what()}});
    throw;
  }
}

}  // namespace

PlacedScene read_placed_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_placed_scene_text(read_scene_bytes(file), file.string(), overrides);
}

PlacedScene read_placed_scene_text(const std::string& text, const std::string& name,
                                   const std::vector<std::string>& overrides) {
  SceneReading reading = read_scene_text(text, name, overrides, find_problems);
  check_memory(lay_out_chains(reading.config));
  // What is only known once fibers are placed is said where its key stands, which only the text knows.
  const auto reject = [&](const std::vector<KeyProblem>& problems) {
    if (!problems.empty()) read_scene_text(text, name, overrides, [&](const SceneConfig&) { return problems; });
  };
  try {
    SceneConfig placed = place(resolve_chains(reading.config), reject);
    reject(find_problems_of_placed(reading.config, placed));
    reading.config = resolve_times(std::move(placed));
    std::string resolved = write_readable_scene(reading.config);
    return {std::move(reading.config), std::move(reading.warnings), std::move(resolved)};
  } catch (const SceneError&) {
    throw;
  } catch (const Error& error) {
    if (error.code() != ExitCode::scene_error) throw;
    throw SceneError(name, {Problem{{name, 0, 0, -1}, error.what(), ""}});
  }
}

}  // namespace skein
