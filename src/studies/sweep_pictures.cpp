// What pictures of a sweep can show.
#include <skein/core/error.hpp>
#include <skein/scene/nearest_name.hpp>

#include "studies/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein {
namespace {

/// What is wrong with the names of a picture; empty where nothing is.
std::string find_fault(const SweepConfig& sweep, const SweepPicture& picture) {
  const auto columns = list_sweep_columns(sweep);
  for (const std::string& name : {picture.value, picture.x, picture.y, picture.by}) {
    if (name.empty() || std::find(columns.begin(), columns.end(), name) != columns.end()) continue;
    const std::string nearest = find_nearest_name(name, columns);
    return fmt::format("the table has no column '{}'{}", name,
                       nearest.empty() ? fmt::format("; it has {}", fmt::join(columns, ", "))
                                       : fmt::format("; did you mean '{}'?", nearest));
  }
  return {};
}

}  // namespace

std::vector<std::string> list_sweep_columns(const SweepConfig& sweep) {
  std::vector<std::string> columns;
  for (const SweepParameter& parameter : sweep.parameters) columns.push_back(parameter.key);
  for (const MeasuredQuantity& quantity : list_run_quantities()) columns.emplace_back(quantity.name);
  for (const MeasuredQuantity& quantity : list_fiber_quantities()) columns.emplace_back(quantity.name);
  return columns;
}

void check_sweep_picture(const SweepConfig& sweep, const SweepPicture& picture) {
  const std::string fault = find_fault(sweep, picture);
  if (!fault.empty())
    throw Error(ExitCode::usage, fmt::format("--picture {}: {}", describe_sweep_picture(picture), fault));
}

void check_sweep_pictures(const std::filesystem::path& file, const SweepConfig& sweep) {
  std::vector<Problem> problems;
  for (const SweepPicture& picture : sweep.pictures) {
    const std::string fault = find_fault(sweep, picture);
    if (!fault.empty()) problems.push_back({{file.string(), picture.line, picture.column, -1}, fault, ""});
  }
  if (!problems.empty()) throw SceneError(file.string(), std::move(problems), "sweep");
}

std::vector<SweepPicture> choose_sweep_pictures(const SweepConfig& sweep) {
  std::vector<std::string> varied;  // one of each axis
  for (std::size_t axis = 0; axis < sweep.n_axes; ++axis)
    for (const SweepParameter& parameter : sweep.parameters)
      if (parameter.axis == axis) {
        if (parameter.values.size() > 1) varied.push_back(parameter.key);
        break;
      }
  if (varied.empty()) return {};
  if (varied.size() == 1)
    return {{"regime", varied[0], "", ""}, {"half_period", varied[0], "", ""}, {"curvature_max", varied[0], "", ""}};
  return {{"regime", varied[0], varied[1], ""}, {"curvature_max", varied[0], varied[1], ""}};
}

std::string describe_sweep_picture(const SweepPicture& picture) {
  std::string text = fmt::format("{} over {}", picture.value, picture.x);
  if (!picture.y.empty()) text += " and " + picture.y;
  if (!picture.by.empty()) text += " by " + picture.by;
  return text;
}

}  // namespace skein
