#include "studies/plan_candidates.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/symmetry_check.hpp>

#include "studies/ladder_table.hpp"
#include "studies/rung.hpp"
#include "studies/rung_name.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace skein {
namespace {

/// Why a rung cannot stand for a scene's fibers, before it is tried; empty where it can.
std::string find_bar(const SceneConfig& scene, const int rung) {
  if (rung == rigid_rung) return find_bar_to_rigid(scene);
  if (rung == chain_rung && !scene.torques.empty()) return "a chain knows no twist";
  if (rung == chain_rung &&
      std::any_of(scene.fibers.begin(), scene.fibers.end(), [](const FiberConfig& fiber) { return fiber.is_helix(); }))
    return "only tubes are helices at rest";
  if (rung == chain_rung && !scene.clamps.empty()) return "no clamp turns a chain";
  return rung == chain_rung && !scene.undulations.empty() ? "only tubes undulate" : "";
}

}  // namespace

Candidate make_candidate(const SceneConfig& scene, const int rung) {
  Candidate candidate;
  candidate.nodes_per_section = rung;
  candidate.error = std::numeric_limits<double>::quiet_NaN();
  candidate.verdict = find_bar(scene, rung);
  if (candidate.verdict.empty()) try {
      candidate.scene = make_rung_scene(scene, rung);
      candidate.n_nodes = count_nodes(make_fibers(candidate.scene.fibers));
      const auto problems = find_symmetry_problems(candidate.scene);
      if (!problems.empty()) candidate.verdict = problems.front().message;
    } catch (const Error& error) {
      candidate.verdict = error.what();
    }
  candidate.is_barred = !candidate.verdict.empty();
  if (candidate.is_barred) candidate.error = std::numeric_limits<double>::infinity();
  return candidate;
}

std::vector<Candidate> list_candidates(const SceneConfig& scene) {
  std::set<int> rungs{rigid_rung};
  for (const LadderRow& row : list_ladder()) rungs.insert(row.nodes_per_section);
  int finest = rigid_rung;
  for (const FiberConfig& fiber : scene.fibers) finest = std::max(finest, find_rung(fiber));
  rungs.insert(finest);

  std::vector<Candidate> candidates;
  for (const int rung : rungs) candidates.push_back(make_candidate(scene, rung));
  if (std::none_of(candidates.begin(), candidates.end(), [](const Candidate& candidate) { return candidate.bends(); }))
    throw Error(ExitCode::scene_error,
                "no chain or tube can stand for the scene's fibers: " + candidates.back().verdict);
  return candidates;
}

void estimate_seconds(std::vector<Candidate>& candidates) {
  const auto known = std::find_if(candidates.rbegin(), candidates.rend(),
                                  [](const Candidate& candidate) { return candidate.seconds > 0.0; });
  if (known == candidates.rend()) return;
  for (Candidate& candidate : candidates)
    if (!(candidate.seconds > 0.0) && !candidate.is_barred)
      candidate.seconds = known->seconds * std::pow(1.0 * candidate.n_nodes / known->n_nodes, 2);
}

}  // namespace skein
