// The numbers of an analysis as files.
#include <skein/core/error.hpp>
#include <skein/io/array_file.hpp>

#include "runs/run_analysis.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace skein {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Columns of one fiber, a value for each frame.
class Columns {
 public:
  explicit Columns(const std::size_t n_frames) : n_frames_(n_frames) {}

  template <class ValueAt>
  void add(const char* name, const char* unit, const ValueAt& value_at) {
    NamedArray column{name, unit, {n_frames_}, {}};
    for (std::size_t i = 0; i < n_frames_; ++i) column.values.push_back(value_at(i));
    columns_.push_back(std::move(column));
  }

  std::vector<NamedArray> take() { return std::move(columns_); }

 private:
  std::size_t n_frames_;
  std::vector<NamedArray> columns_;
};

void add_hook(Columns& columns, const char* radius_name, const char* place_name,
              const std::vector<std::optional<Hook>>& hooks) {
  columns.add(radius_name, "length", [&](const std::size_t i) { return hooks[i] ? hooks[i]->circle.radius : none; });
  columns.add(place_name, "length", [&](const std::size_t i) { return hooks[i] ? hooks[i]->arclength : none; });
}

void add_vector(Columns& columns, const char* const (&names)[3], const char* unit,
                const std::vector<ForceRecord>& forces, Vec3 ForceRecord::*const vector) {
  columns.add(names[0], unit, [&](const std::size_t i) { return (forces[i].*vector).x; });
  columns.add(names[1], unit, [&](const std::size_t i) { return (forces[i].*vector).y; });
  columns.add(names[2], unit, [&](const std::size_t i) { return (forces[i].*vector).z; });
}

void add_forces(Columns& columns, const std::vector<ForceRecord>& forces) {
  add_vector(columns, {"middle_x", "middle_y", "middle_z"}, "length", forces, &ForceRecord::middle);
  add_vector(columns, {"force_x", "force_y", "force_z"}, "force", forces, &ForceRecord::force);
  add_vector(columns, {"torque_x", "torque_y", "torque_z"}, "force*length", forces, &ForceRecord::torque);
  columns.add("energy", "force*length", [&](const std::size_t i) { return forces[i].energy; });
  columns.add("elastic_power", "force*length/time", [&](const std::size_t i) { return forces[i].power.elastic(); });
  columns.add("background_power", "force*length/time", [&](const std::size_t i) { return forces[i].power.background; });
  columns.add("dissipation", "force*length/time", [&](const std::size_t i) { return forces[i].power.dissipation; });
  columns.add("drive_power", "force*length/time", [&](const std::size_t i) { return forces[i].power.drive; });
  constexpr const char* names[3][3] = {
      {"stresslet_xx", "stresslet_xy", "stresslet_xz"}, {"", "stresslet_yy", "stresslet_yz"}, {"", "", "stresslet_zz"}};
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b)
      columns.add(names[a][b], "force*length", [&](const std::size_t i) { return forces[i].stresslet[a][b]; });
  columns.add("viscosity_contribution", "length^3",
              [&](const std::size_t i) { return forces[i].viscosity_contribution; });
}

std::vector<NamedArray> make_columns(const RunAnalysis& analysis, const std::size_t fiber) {
  const FiberHistory& history = analysis.histories[fiber];
  const auto& shapes = history.shapes();
  const auto angle = history.angles();
  Columns columns(analysis.time.size());
  columns.add("time", "time", [&](const std::size_t i) { return analysis.time[i]; });
  columns.add("fiber", "", [&](std::size_t) { return static_cast<double>(fiber); });
  columns.add("regime", "", [&](const std::size_t i) { return static_cast<double>(history.regimes()[i]); });
  columns.add("angle", "degree", [&](const std::size_t i) { return degrees * angle[i]; });
  columns.add("distance", "length", [&](const std::size_t i) { return shapes[i].distance; });
  columns.add("centreline_length", "length", [&](const std::size_t i) { return shapes[i].length; });
  columns.add("stretch", "", [&](const std::size_t i) { return shapes[i].length / shapes[0].length - 1.0; });
  columns.add("curvature_max", "1/length", [&](const std::size_t i) { return shapes[i].curvature_max; });
  columns.add("total_turning", "degree", [&](const std::size_t i) { return degrees * shapes[i].total_turning; });
  columns.add("bends", "", [&](const std::size_t i) { return static_cast<double>(shapes[i].bends.size()); });
  columns.add("symmetry_defect", "", [&](const std::size_t i) { return shapes[i].symmetry_defect; });
  columns.add("out_of_plane", "length", [&](const std::size_t i) { return shapes[i].out_of_plane; });
  columns.add("out_of_flow_plane", "length", [&](const std::size_t i) {
    return history.out_of_flow_plane().empty() ? none : history.out_of_flow_plane()[i];
  });
  columns.add("deflection", "length", [&](const std::size_t i) { return shapes[i].deflection; });
  columns.add("smallest_gap", "length", [&](const std::size_t i) { return analysis.smallest_gap[i]; });
  columns.add("nodes_inside", "", [&](const std::size_t i) { return static_cast<double>(analysis.nodes_inside[i]); });
  columns.add("depth", "length", [&](const std::size_t i) { return analysis.depth[i]; });
  columns.add("crossings", "", [&](const std::size_t i) { return static_cast<double>(analysis.crossings[i]); });
  add_hook(columns, "first_hook_radius", "first_hook_place", history.hooks(FiberEnd::first));
  add_hook(columns, "last_hook_radius", "last_hook_place", history.hooks(FiberEnd::last));
  if (!analysis.forces.empty()) add_forces(columns, analysis.forces[fiber]);
  return columns.take();
}

/// All points of all tracks, and a row about each track.
void add_tracks(const FiberSummary& summary, const double fiber_length, const std::string& group,
                std::vector<NamedArray>& arrays) {
  NamedArray points{group + "track_points", "", {0, 4}, {}}, tracks{group + "tracks", "", {0, 6}, {}};
  for (const ExtremumTrack& track : summary.tracks) {
    const LineFit fit = track.fit();
    for (std::size_t i = 0; i < track.time.size(); ++i) {
      const double row[] = {static_cast<double>(tracks.shape[0]), track.time[i], track.arclength[i],
                            track.curvature[i]};
      points.values.insert(points.values.end(), std::begin(row), std::end(row));
      ++points.shape[0];
    }
    const double row[] = {track.time.front(), track.time.back(), fit.intercept,
                          fit.slope,          fit.determination, static_cast<double>(judge_wave(track, fiber_length))};
    tracks.values.insert(tracks.values.end(), std::begin(row), std::end(row));
    ++tracks.shape[0];
  }
  arrays.push_back(std::move(points));
  arrays.push_back(std::move(tracks));
}

/// Of the circle at the first section's end; NaN where there is no hook.
NamedArray make_hook_centers(const FiberHistory& history, const std::string& group) {
  NamedArray centers{group + "first_hook_center", "length", {history.time().size(), 3}, {}};
  for (const auto& hook : history.hooks(FiberEnd::first)) {
    const Vec3 center = hook ? hook->circle.center : Vec3{none, none, none};
    centers.values.insert(centers.values.end(), {center.x, center.y, center.z});
  }
  return centers;
}

/// Rows: along, gradient, normal, see FlowFrame; zero where the flow has no such direction.
NamedArray make_flow_frame_rows(const FlowFrame& flow, const std::string& group) {
  NamedArray rows{group + "flow_frame", "", {3, 3}, {}};
  for (const Vec3 row : {flow.along, flow.gradient, flow.normal})
    rows.values.insert(rows.values.end(), {row.x, row.y, row.z});
  return rows;
}

/// Of the fiber's own plane, about which its curvature is positive counter-clockwise.
NamedArray make_normals(const FiberHistory& history, const std::string& group) {
  NamedArray normals{group + "normal", "", {history.time().size(), 3}, {}};
  for (const Shape& shape : history.shapes())
    normals.values.insert(normals.values.end(), {shape.normal.x, shape.normal.y, shape.normal.z});
  return normals;
}

std::string list_regimes() {
  std::string text;
  for (int i = 0; i <= static_cast<int>(Regime::three_dimensional); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, name_of(static_cast<Regime>(i)));
  return text;
}

std::string list_angle_origins() {
  std::string text;
  for (int i = 0; i <= static_cast<int>(AngleOrigin::own_direction); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, name_of(static_cast<AngleOrigin>(i)));
  return text;
}

}  // namespace

void write_analysis(const RunAnalysis& analysis, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::cannot_create, fmt::format("cannot create '{}': {}.", folder.string(), error.message()));
  const std::size_t n_frames = analysis.time.size();
  std::vector<NamedArray> arrays{{"time", "time", {n_frames}, analysis.time}}, table;
  for (std::size_t f = 0; f < analysis.fibers.size(); ++f) {
    const std::string group = fmt::format("fiber_{}/", f);
    auto columns = make_columns(analysis, f);
    if (table.empty()) table.resize(columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      NamedArray& whole = table[c];
      whole.name = columns[c].name;
      whole.unit = columns[c].unit;
      whole.values.insert(whole.values.end(), columns[c].values.begin(), columns[c].values.end());
      columns[c].name = group + columns[c].name;
      arrays.push_back(std::move(columns[c]));
    }
    const auto n_sections = static_cast<std::size_t>(analysis.fibers[f].config.sections);
    const FiberHistory& history = analysis.histories[f];
    arrays.push_back({group + "signed_curvature", "1/length", {n_frames, n_sections}, history.curvature()});
    arrays.push_back({group + "arclength", "length", {n_frames, n_sections}, history.arclength()});
    const FiberSummary summary = history.summarize();
    add_tracks(summary, analysis.fibers[f].length(), group, arrays);
    arrays.push_back(make_hook_centers(history, group));
    arrays.push_back(make_flow_frame_rows(history.flow(), group));
    arrays.push_back({group + "angle_origin", "", {1}, {static_cast<double>(history.flow().angle_origin)}});
    arrays.push_back(make_normals(history, group));
    NamedArray snaking{group + "snaking", "", {0, 5}, {}};
    if (const auto& s = summary.snaking) {
      snaking.shape[0] = 1;
      snaking.values = {s->begin, s->end, s->hook_radius, s->speed, s->determination};
    }
    arrays.push_back(std::move(snaking));
  }
  write_array_file(folder / "diagnostics.h5", arrays,
                   {{"regimes", list_regimes()},
                    {"track_points", "track, time, arclength, signed curvature"},
                    {"tracks", "first time, last time, intercept, speed, determination, wave"},
                    {"angle_origins", list_angle_origins()},
                    {"flow_frame", "along, gradient, normal"},
                    {"snaking", "from, to, hook radius, speed, determination"},
                    {"waves", "0 standing, 1 travelling, 2 unclear"}});
  write_csv(folder / "diagnostics.csv", table);
}

}  // namespace skein
