#include "studies/lagrone2019.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/fibers/spring_network.hpp>

#include "studies/paper_run.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/rung.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double straightness(const Shape& shape) { return shape.distance / shape.length; }
double half_turns(const Shape& shape) { return shape.total_turning / std::numbers::pi; }
double n_bends(const Shape& shape) { return static_cast<double>(shape.bends.size()); }

std::vector<AcceptanceRow> compare_table1(const PaperRuns& /*runs*/, const std::vector<SumTiming>& /*timings*/) {
  FigureRows rows;
  const auto fiber_of = [](const PaperFiber& paper) {
    return make_fibers(make_paper_scene(paper.sections, paper.end).fibers)[0];
  };
  const Fiber shortest = fiber_of(list_paper_fibers().front()), longest = fiber_of(list_paper_fibers().back());
  rows.add("shortest length", "Table 1", compare_number(0.139, shortest.length(), 5e-4));
  rows.add("longest length", "Table 1", compare_number(2.28, longest.length(), 5e-3));
  rows.add("largest slenderness R/L", "Table 1",
           compare_number(0.036, shortest.config.radius / shortest.length(), 5e-4));
  rows.add("smallest slenderness R/L", "Table 1",
           compare_number(0.0022, longest.config.radius / longest.length(), 5e-5));
  rows.add("node spacing", "Table 1", compare_number(0.00174, shortest.spacing(), 5e-6));
  rows.add("fewest nodes", "Table 1", compare_number(1440, shortest.n_nodes(), 0));
  rows.add("most nodes", "Table 1", compare_number(23634, longest.n_nodes(), 0));
  // 17 in its section and 18 in each neighbour: counted as what one more section adds.
  const auto springs = [](int sections) {
    return count_springs(make_spring_network(make_fibers(make_paper_scene(sections, 1.0).fibers)[0]));
  };
  rows.add("springs of an inner node", "Section 2.2",
           compare_number(53, 17.0 + 2.0 * static_cast<double>(springs(4) - springs(3) - 153) / 18.0, 0));
  rows.add("bending rigidity EI", "Table 1", compare_number(4.8e-6, measure_beam_stiffness(shortest).bending, 0.05e-6));
  for (const PaperFiber& paper : list_paper_fibers()) {
    const Fiber fiber = fiber_of(paper);
    const double number =
        compute_elasto_viscous_numbers(fiber, 1.0, 2.5, measure_beam_stiffness(fiber).bending).with_log_4e_over_rho2;
    rows.add(fmt::format("mu_bar, c = ln(4e/rho^2), L = {:.3g}", fiber.length()), "Figures 2, 4, 5",
             compare_number(paper.elasto_viscous_number, number, 0.005 * paper.elasto_viscous_number));
  }
  return rows.take();
}

/// A fiber that starts straight along x must stay in its plane and odd about its middle: "In the absence of Brownian
/// fluctuations" in Section 4.
void compare_symmetries(FigureRows& rows, const PaperRun& run, const char* length, const double end) {
  const bool has = run.has(end);
  rows.add(fmt::format("L = {}: out of the plane at most, in radii", length), "Section 4, symmetries",
           compare_range(-infinity, 0.01, has ? run.summary().out_of_plane_max / paper_radius : nan));
  rows.add(fmt::format("L = {}: departure from odd symmetry at most, over its length", length), "Section 4, symmetries",
           compare_range(-infinity, 0.01, has ? run.summary().symmetry_defect_max : nan));
}

void compare_tumbling(FigureRows& rows, const PaperRuns& runs) {
  const PaperRun run(runs, "L0139");
  const std::string snapshot = "Figure 2, first column";
  rows.add("L = 0.139: angle at t = 4.95 (degrees)", snapshot, compare_number(40, run.angle(4.95), 3));
  rows.add("L = 0.139: slight bends at t = 4.95", "Section 4", compare_number(2, run.at(4.95, n_bends), 0));
  rows.add("L = 0.139: angle at t = 5.45 (degrees)", snapshot, compare_number(90, run.angle(5.45), 3));
  rows.add("L = 0.139: angle at t = 5.7 (degrees)", snapshot, compare_range(90, 150, run.angle(5.7)));
  rows.add("L = 0.139: angle at t = 7 (degrees)", snapshot, compare_range(150, 178, run.angle(7.0)));
  rows.add("L = 0.139: angle at t = 10.75 (degrees)", snapshot, compare_number(180, run.angle(10.75), 2));
  rows.add("L = 0.139: half period", snapshot, compare_number(10.9, run.half_period(), 0.1));
  rows.add("L = 0.139: regime", "Section 4",
           compare_word("tumble", run.has(11.0) ? name_of(run.summary().regime) : ""));
  rows.add("L = 0.139: largest compression (%)", "Section 4",
           compare_range(1, 5, run.has(11.0) ? -100.0 * run.summary().stretch_min : nan));
}

void compare_s_turn(FigureRows& rows, const PaperRuns& runs) {
  const PaperRun run(runs, "L0196");
  const std::string snapshot = "Figure 2, second column";
  for (const double time : {5.65, 6.5, 7.15})
    rows.add(fmt::format("L = 0.196: shape at t = {:g}", time), snapshot, compare_word("S", run.regime(time)));
  rows.add("L = 0.196: end distance / length at t = 8.75", snapshot,
           compare_range(0.99, infinity, run.at(8.75, straightness)));
  rows.add("L = 0.196: angle at t = 13.5 (degrees)", snapshot, compare_number(180, run.angle(13.5), 2));
  rows.add("L = 0.196: half period", snapshot, compare_number(14.0, run.half_period(), 0.5));
  rows.add("L = 0.196: regime", "Section 4", compare_word("S", run.has(14.0) ? name_of(run.summary().regime) : ""));
}

void compare_snaking(FigureRows& rows, const PaperRuns& runs) {
  const PaperRun run(runs, "L0523");
  const std::string snapshot = "Figure 2, third column";
  for (const double time : {6.25, 8.0})
    rows.add(fmt::format("L = 0.523: hooks at t = {:g}", time), snapshot, compare_number(2, run.count_hooks(time), 0));
  rows.add("L = 0.523: hooks near the middle at t = 10.5 (place / length)", snapshot,
           compare_range(0.33, 0.5, run.hook_place(10.5)));
  rows.add("L = 0.523: end distance / length at t = 12.75", snapshot,
           compare_range(0.9, infinity, run.at(12.75, straightness)));
  rows.add("L = 0.523: angle at t = 25 (degrees)", snapshot, compare_number(180, run.angle(25.0), 2));
  rows.add("L = 0.523: half period", snapshot, compare_number(25, run.half_period(), 1));
  rows.add("L = 0.523: regime", "Section 4", compare_word("snake", run.has(13.0) ? name_of(run.summary().regime) : ""));
}

std::vector<AcceptanceRow> compare_figure2(const PaperRuns& runs, const std::vector<SumTiming>& /*timings*/) {
  FigureRows rows;
  compare_tumbling(rows, runs);
  compare_s_turn(rows, runs);
  compare_snaking(rows, runs);
  compare_symmetries(rows, PaperRun(runs, "L0139"), "0.139", 40.0);
  compare_symmetries(rows, PaperRun(runs, "L0196"), "0.196", 30.0);
  compare_symmetries(rows, PaperRun(runs, "L0523"), "0.523", 26.0);
  for (const auto& [name, length] : {std::pair{"L0139", "0.139"}, {"L0196", "0.196"}, {"L0523", "0.523"}})
    rows.add(fmt::format("L = {}: share of the first half turn in which it is nearly straight along x", length),
             "Section 4, most of the orbit", compare_range(0.5, 1.0, PaperRun(runs, name).share_at_rest()));
  const double periods[] = {PaperRun(runs, "L0139").half_period(), PaperRun(runs, "L0196").half_period(),
                            PaperRun(runs, "L0523").half_period()};
  rows.add("period at 0.196 over that at 0.139: grows", "Section 4",
           compare_range(1, infinity, periods[1] / periods[0]));
  rows.add("period at 0.523 over that at 0.196: grows", "Section 4",
           compare_range(1, infinity, periods[2] / periods[1]));
  return rows.take();
}

std::vector<AcceptanceRow> compare_figure3(const PaperRuns& runs, const std::vector<SumTiming>& /*timings*/) {
  FigureRows rows;
  const auto add = [&](const char* name, const char* length, const char* panel, const double end, const char* wave) {
    rows.add(fmt::format("L = {}: extrema of curvature", length), panel,
             compare_word(wave, PaperRun(runs, name).wave(end)));
  };
  add("L0139", "0.139", "Figure 3 a", 11.0, "standing");
  add("L0196", "0.196", "Figure 3 b", 14.0, "standing");
  add("L0523", "0.523", "Figure 3 c", 13.0, "travelling");
  return rows.take();
}

std::vector<AcceptanceRow> compare_figure4(const PaperRuns& runs, const std::vector<SumTiming>& /*timings*/) {
  FigureRows rows;
  const PaperRun run(runs, "L0931");
  rows.add("L = 0.931: bent ends at t = 4.95", "Figure 4", compare_range(2, infinity, run.at(4.95, [](const Shape& s) {
             return std::count_if(s.bends.begin(), s.bends.end(),
                                  [](const Bend& b) { return std::abs(b.turning) > 0.6; });
           })));
  rows.add("L = 0.931: bends at t = 16.25: several", "Figure 4", compare_range(4, infinity, run.at(16.25, n_bends)));
  double straightest = 0.0;
  constexpr double folded = 8.0, end = 31.25;
  if (run.has(end))
    for (std::size_t i = run.frame(folded); i <= run.frame(end); ++i)
      straightest = std::max(straightest, straightness(run.history()->shapes()[i]));
  rows.add("L = 0.931: largest end distance / length from t = 8: never straight again", "Section 4",
           compare_range(-infinity, 0.95, run.has(end) ? straightest : nan));
  rows.add("L = 0.931: extrema of curvature", "Figure 3 d", compare_word("travelling", run.wave(end)));
  compare_symmetries(rows, run, "0.931", end);
  return rows.take();
}

std::vector<AcceptanceRow> compare_figure5(const PaperRuns& runs, const std::vector<SumTiming>& /*timings*/) {
  FigureRows rows;
  const PaperRun run(runs, "L2280");
  rows.add("L = 2.28: hooks at t = 10", "Figure 5", compare_number(2, run.count_hooks(10.0), 0));
  for (const double time : {31.0, 36.0, 39.0, 44.0})
    rows.add(fmt::format("L = 2.28: out of the plane at t = {:g}, in radii", time), "Figure 5",
             compare_range(-infinity, 0.1, run.radii_out_of_plane(time)));
  rows.add("L = 2.28: time at which it is a radius out of the plane", "Section 4, at about 50",
           compare_range(45.0, 55.0, run.time_out_of_plane(110.0)));
  rows.add("L = 2.28: bends at t = 36: many", "Figure 3 f", compare_range(6, infinity, run.at(36.0, n_bends)));
  rows.add("L = 2.28: total turning at t = 36 (half turns)", "Figure 5",
           compare_range(3, infinity, run.at(36.0, half_turns)));
  return rows.take();
}

std::vector<AcceptanceRow> compare_figure6(const PaperRuns& runs, const std::vector<SumTiming>& /*timings*/) {
  FigureRows rows;
  const PaperRun run(runs, "L2280");
  rows.add("L = 2.28: shape at t = 110", "Figure 6", compare_word("three-dimensional", run.regime(110.0)));
  rows.add("L = 2.28: total turning at t = 110 (half turns)", "Figure 6, an entangled state",
           compare_range(3, infinity, run.at(110.0, half_turns)));
  rows.add("L = 2.28: out of the plane at t = 110, in radii", "Figure 6",
           compare_range(1, infinity, run.radii_out_of_plane(110.0)));
  return rows.take();
}

std::vector<AcceptanceRow> compare_figure7(const PaperRuns& runs, const std::vector<SumTiming>& /*timings*/) {
  FigureRows rows;
  std::optional<Snaking> reference;
  for (const auto& [name, length] : {std::pair{"L0523", "0.523"}, {"L0931", "0.931"}, {"L2280", "2.28"}}) {
    if (runs.count(name) == 0 && reference) continue;
    const PaperRun run(runs, name);
    const auto snaking = run.has(0.0) ? run.summary().snaking : std::nullopt;
    double spread = nan;
    if (snaking) {
      std::vector<double> radii;
      for (const FiberEnd end : {FiberEnd::first, FiberEnd::last})
        for (std::size_t i = run.frame(snaking->begin); i <= run.frame(snaking->end); ++i)
          if (const auto& hook = run.history()->hooks(end)[i]) radii.push_back(hook->circle.radius);
      const auto [low, high] = std::minmax_element(radii.begin(), radii.end());
      spread = (*high - *low) / snaking->hook_radius;
    }
    rows.add(fmt::format("L = {}: hook radius {:.4g}, spread while it travels", length,
                         snaking ? snaking->hook_radius : nan),
             "Section 4, a fixed radius", compare_range(-infinity, 0.1, spread));
    rows.add(fmt::format("L = {}: snaking speed {:.4g}, r^2 of the line", length, snaking ? snaking->speed : nan),
             "Figure 3 c-e, slopes", compare_range(0.95, 1, snaking ? snaking->determination : nan));
    if (!reference) {
      reference = snaking;
      continue;
    }
    if (!snaking) continue;
    rows.add(fmt::format("L = {}: hook radius over that at 0.523", length), "Figure 7 b",
             compare_number(1, snaking->hook_radius / reference->hook_radius, 0.1));
    rows.add(fmt::format("L = {}: snaking speed over that at 0.523", length), "Figure 7 b",
             compare_number(1, snaking->speed / reference->speed, 0.1));
  }
  return rows.take();
}

std::vector<AcceptanceRow> compare_figure8(const PaperRuns& /*runs*/, const std::vector<SumTiming>& timings) {
  FigureRows rows;
  rows.add("nodes from which on the fast multipole method is faster", "Figure 8",
           compare_range(-infinity, 1.7e4, find_crossover(timings)));
  const SumTiming last = timings.empty() ? SumTiming{23634, nan, nan, nan} : timings.back();
  rows.add(fmt::format("times faster than the direct sum, {} nodes", last.n_nodes),
           "Section 4, computational considerations",
           compare_range(1.6, infinity, last.direct_seconds / last.fmm_seconds));
  rows.add("its error there", "ours: a tolerance of 1e-4", compare_range(-infinity, 1e-4, last.fmm_error));
  return rows.take();
}

}  // namespace

SceneConfig make_run_scene(const PaperFiber& fiber, const int rung) {
  SceneConfig scene = make_rung_scene(make_paper_scene(fiber.sections, fiber.end), rung);
  scene.fibers[0].start_noise = fiber.start_noise;
  if (fiber.keeps_plane) {
    // Direct sums in double keep the scene's mirror and half turn to rounding. The fast multipole method breaks both by
    // its error, and brings L = 0.931 out of its plane by 0.05 radii, L = 2.28 by many from t = 33 on.
    scene.hydrodynamics.method = SumMethod::direct;
    scene.hydrodynamics.precision = Precision::in_double;
  }
  return scene;
}

const std::vector<PaperFiber>& list_paper_fibers() {
  using enum Figure;
  static const std::vector<PaperFiber> fibers{{"L0139", 80, 40.0, 5.35e2, {figure2, figure3}},
                                              {"L0196", 113, 30.0, 1.97e3, {figure2, figure3}},
                                              {"L0523", 301, 26.0, 8.22e4, {figure2, figure3, figure4, figure7}},
                                              {"L0931", 536, 31.25, 7.51e5, {figure4}, 9, true},
                                              {"L2280", 1313, 110.0, 2.37e7, {figure5, figure6}, 6, true, 1e-11}};
  return fibers;
}

const std::vector<PaperFigure>& list_paper_figures() {
  using enum Figure;
  static const std::vector<PaperFigure> figures{
      {table1, "table1", "geometry, rigidity, elasto-viscous numbers; no runs", compare_table1},
      {figure2, "figure2", "tumbling, S-turn and snaking: lengths 0.139, 0.196, 0.523", compare_figure2},
      {figure3, "figure3", "curvature in time: standing and travelling extrema", compare_figure3},
      {figure7, "figure7", "radius and speed of the hooks", compare_figure7},
      {figure4, "figure4", "length 0.931 to t = 31.25; minutes", compare_figure4},
      {figure5, "figure5", "length 2.28 to t = 110; half an hour", compare_figure5},
      {figure6, "figure6", "length 2.28 at t = 110, seen from the side: the run of figure 5", compare_figure6},
      {figure8, "figure8", "times of direct sums and of the fast multipole method; no runs", compare_figure8}};
  return figures;
}

const PaperFigure& find_paper_figure(const Figure figure) {
  const auto& figures = list_paper_figures();
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const PaperFigure& one) { return one.figure == figure; });
  SKEIN_REQUIRE(found != figures.end(), "each figure is in the list");
  return *found;
}

std::vector<AcceptanceRow> compare_with_paper(const Figure figure, const PaperRuns& runs,
                                              const std::vector<SumTiming>& timings) {
  const PaperFigure& compared = find_paper_figure(figure);
  auto rows = compared.compare(runs, timings);
  for (AcceptanceRow& row : rows) row.figure = compared.name;
  return rows;
}

}  // namespace skein
