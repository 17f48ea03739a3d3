#include "studies/ladder.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/io/array_file.hpp>

#include "studies/ladder_table.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/reference_run.hpp"
#include "studies/rung.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace skein {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t n_frames = 400;

SceneConfig make_ladder_scene(const double length, const double stiffness, const int nodes_per_section) {
  SceneConfig paper = make_paper_scene(count_paper_sections(length), find_ladder_end(length));
  paper.fibers[0].spring_stiffness *= stiffness;
  SceneConfig scene = make_rung_scene(std::move(paper), nodes_per_section);
  scene.time.tolerance = ladder_time_tolerance;
  scene.hydrodynamics.tolerance = ladder_sum_tolerance;
  return scene;
}

/// One frame of a run, to compare shapes at; nothing where the run did not get there.
Pilot take_frame(const Pilot& pilot, const std::size_t frame) {
  Pilot part;
  part.analysis.fibers = pilot.analysis.fibers;
  if (frame < pilot.centreline.size()) part.centreline.push_back(pilot.centreline[frame]);
  return part;
}

LadderPoint make_point(const double length, const int nodes_per_section, const Pilot& pilot) {
  LadderPoint point;
  point.length = length;
  point.nodes_per_section = nodes_per_section;
  point.n_nodes = count_nodes(pilot.analysis.fibers);
  point.seconds = pilot.seconds;
  point.evaluations = pilot.evaluations;
  const FiberSummary summary = pilot.analysis.histories[0].summarize();
  point.half_period = summary.half_periods.empty() ? unknown : summary.half_periods[0];
  point.hook_radius = summary.snaking ? summary.snaking->hook_radius : unknown;
  point.snaking_speed = summary.snaking ? summary.snaking->speed : unknown;
  point.curvature_max = summary.curvature_max;
  return point;
}

}  // namespace

std::vector<LadderPoint> measure_ladder(const LadderStudy& study,
                                        const std::function<void(const LadderPoint&)>& report) {
  std::vector<LadderPoint> points;
  for (const double length : study.lengths) {
    std::optional<Pilot> finest;
    for (const int rung : study.rungs) {
      const SceneConfig scene = make_ladder_scene(length, study.stiffness, rung);
      Pilot pilot =
          finest ? run_pilot(scene, n_frames, std::numeric_limits<double>::infinity()) : run_reference(scene, n_frames);
      if (!pilot.failure.empty()) throw Error(ExitCode::numerical, pilot.failure);
      LadderPoint point = make_point(length, rung, pilot);
      if (finest) {
        point.errors = compare_answers(pilot, *finest, list_questions());
        for (std::size_t third = 0; third < 3; ++third) {
          const std::size_t frame = n_frames * (third + 1) / 3;
          point.shape_errors[third] = find_largest_error(
              compare_answers(take_frame(pilot, frame), take_frame(*finest, frame), {Question::shape}));
        }
      } else {
        finest = std::move(pilot);
      }
      report(point);
      points.push_back(std::move(point));
    }
  }
  return points;
}

void write_ladder(const std::filesystem::path& path, const std::vector<LadderPoint>& points) {
  std::vector<NamedArray> columns;
  const auto add = [&](const std::string& name, const std::string& unit, const auto& value) {
    NamedArray& column = columns.emplace_back(NamedArray{name, unit, {points.size()}, {}});
    for (const LadderPoint& point : points) column.values.push_back(value(point));
  };
  add("length", "length", [](const LadderPoint& p) { return p.length; });
  add("nodes_per_section", "", [](const LadderPoint& p) { return 1.0 * p.nodes_per_section; });
  add("nodes", "", [](const LadderPoint& p) { return 1.0 * p.n_nodes; });
  add("seconds", "wall time", [](const LadderPoint& p) { return p.seconds; });
  add("evaluations", "", [](const LadderPoint& p) { return static_cast<double>(p.evaluations); });
  add("half_period", "time", [](const LadderPoint& p) { return p.half_period; });
  add("hook_radius", "length", [](const LadderPoint& p) { return p.hook_radius; });
  add("snaking_speed", "length/time", [](const LadderPoint& p) { return p.snaking_speed; });
  add("curvature_max", "1/length", [](const LadderPoint& p) { return p.curvature_max; });
  for (const Question question : list_questions())
    add(std::string(name_of(question)) + "_error", "", [&](const LadderPoint& p) {
      for (const AnswerError& error : p.errors)
        if (error.question == question) return error.error;
      return unknown;
    });
  for (std::size_t third = 0; third < 3; ++third)
    add("shape_error_at_" + std::to_string(third + 1) + "_3", "",
        [&](const LadderPoint& p) { return p.errors.empty() ? unknown : p.shape_errors[third]; });
  write_csv(path, columns);
}

}  // namespace skein
