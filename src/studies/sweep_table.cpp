#include "studies/sweep_table.hpp"

#include <skein/io/array_file.hpp>
#include <skein/io/csv_file.hpp>

#include "studies/sweep_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace skein {
namespace {

using Results = std::vector<std::optional<RunResult>>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const char* describe_state(const std::optional<RunResult>& result) {
  return !result ? "open" : result->code == ExitCode::done ? "done" : "failed";
}

bool is_done(const std::optional<RunResult>& result) { return result && result->code == ExitCode::done; }

std::string with_unit(const MeasuredQuantity& quantity) {
  return quantity.unit[0] == '\0' ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit);
}

/// Texts without TOML's quotes, which other readers of tables would keep.
std::string write_cell(const SweepValue& value) {
  const std::string& text = value.text;
  const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.find('\\') == std::string::npos;
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

void add_scene_values(const Sweep& sweep, const std::size_t run, CsvRow& row) {
  const auto chosen = find_sweep_values(sweep.config, run);
  for (std::size_t p = 0; p < chosen.size(); ++p)
    row.push_back(write_cell(sweep.config.parameters[p].values[chosen[p]]));
}

/// What stands before the values, in each table.
CsvRow begin_heading(const Sweep& sweep, std::vector<std::string> first) {
  for (const SweepParameter& parameter : sweep.config.parameters) first.push_back(parameter.key);
  return first;
}

void write_run_table(const Sweep& sweep, const Results& results) {
  std::vector<CsvRow> rows{begin_heading(sweep, {"run", "state"})};
  for (const MeasuredQuantity& quantity : list_run_quantities()) rows[0].push_back(with_unit(quantity));
  for (const MeasuredQuantity& quantity : list_fiber_quantities()) rows[0].push_back(with_unit(quantity));
  for (std::size_t run = 0; run < results.size(); ++run) {
    CsvRow& row = rows.emplace_back(CsvRow{sweep.runs.names[run], describe_state(results[run])});
    add_scene_values(sweep, run, row);
    const bool done = is_done(results[run]);
    for (std::size_t q = 0; q < list_run_quantities().size(); ++q)
      row.push_back(fmt::format("{}", done ? results[run]->measures.of_run[q] : none));
    for (std::size_t q = 0; q < list_fiber_quantities().size(); ++q)
      row.push_back(fmt::format("{}", done ? results[run]->measures.over_fibers(q) : none));
  }
  write_csv_rows(sweep.folder.table(), rows);
}

void write_fiber_table(const Sweep& sweep, const Results& results) {
  std::vector<CsvRow> rows{begin_heading(sweep, {"run", "fiber"})};
  for (const MeasuredQuantity& quantity : list_fiber_quantities()) rows[0].push_back(with_unit(quantity));
  bool has_several = false;
  for (std::size_t run = 0; run < results.size(); ++run) {
    if (!is_done(results[run])) continue;
    const RunMeasures& measures = results[run]->measures;
    has_several = has_several || measures.n_fibers() > 1;
    for (std::size_t fiber = 0; fiber < measures.n_fibers(); ++fiber) {
      CsvRow& row = rows.emplace_back(CsvRow{sweep.runs.names[run], std::to_string(fiber)});
      add_scene_values(sweep, run, row);
      for (std::size_t q = 0; q < list_fiber_quantities().size(); ++q)
        row.push_back(fmt::format("{}", measures.of_fiber(fiber, q)));
    }
  }
  if (has_several) write_csv_rows(sweep.folder.fibers(), rows);
}

void write_failures(const Sweep& sweep, const Results& results) {
  std::vector<CsvRow> rows{begin_heading(sweep, {"run", "exit_code", "message"})};
  for (std::size_t run = 0; run < results.size(); ++run) {
    if (!results[run] || is_done(results[run])) continue;
    CsvRow& row = rows.emplace_back(
        CsvRow{sweep.runs.names[run], std::to_string(static_cast<int>(results[run]->code)), results[run]->message});
    add_scene_values(sweep, run, row);
  }
  write_csv_rows(sweep.folder.failures(), rows);
}

/// A parameter as numbers: its own, or the places of its values in a list of words.
NamedArray make_parameter_array(const Sweep& sweep, const std::size_t parameter,
                                std::vector<std::pair<std::string, std::string>>& attributes) {
  const SweepParameter& of = sweep.config.parameters[parameter];
  const bool has_numbers =
      std::none_of(of.values.begin(), of.values.end(), [](const auto& value) { return std::isnan(value.number); });
  std::vector<std::string> words;
  for (const SweepValue& value : of.values)
    if (!has_numbers && std::find(words.begin(), words.end(), value.text) == words.end()) words.push_back(value.text);
  std::string legend;
  for (std::size_t i = 0; i < words.size(); ++i) legend += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, words[i]);
  constexpr std::size_t longest_attribute = 60000;
  if (!has_numbers) attributes.emplace_back(of.key, legend.substr(0, longest_attribute));

  NamedArray array{"parameters/" + of.key, "", {sweep.runs.names.size()}, {}};
  for (std::size_t run = 0; run < sweep.runs.names.size(); ++run) {
    const SweepValue& value = of.values[find_sweep_values(sweep.config, run)[parameter]];
    const auto word = std::find(words.begin(), words.end(), value.text) - words.begin();
    array.values.push_back(has_numbers ? value.number : static_cast<double>(word));
  }
  return array;
}

void write_numbers(const Sweep& sweep, const Results& results) {
  std::vector<std::pair<std::string, std::string>> attributes{
      {"title", sweep.config.title.empty() ? "none" : sweep.config.title},
      {"exit_codes", "0 done, -1 open, others: failed"}};
  std::vector<NamedArray> arrays{{"exit_code", "", {results.size()}, {}}};
  for (const auto& result : results) arrays[0].values.push_back(result ? static_cast<double>(result->code) : -1.0);
  for (std::size_t p = 0; p < sweep.config.parameters.size(); ++p)
    arrays.push_back(make_parameter_array(sweep, p, attributes));
  const auto add = [&](const MeasuredQuantity& quantity, const auto& value_of) {
    NamedArray& array =
        arrays.emplace_back(NamedArray{fmt::format("values/{}", quantity.name), quantity.unit, {results.size()}, {}});
    for (const auto& result : results) array.values.push_back(is_done(result) ? value_of(result->measures) : none);
  };
  for (std::size_t q = 0; q < list_run_quantities().size(); ++q)
    add(list_run_quantities()[q], [q](const RunMeasures& measures) { return measures.of_run[q]; });
  for (std::size_t q = 0; q < list_fiber_quantities().size(); ++q)
    add(list_fiber_quantities()[q], [q](const RunMeasures& measures) { return measures.over_fibers(q); });
  write_array_file(sweep.folder.numbers(), arrays, attributes);
}

}  // namespace

void write_sweep_tables(const Sweep& sweep, const Results& results) {
  write_run_table(sweep, results);
  write_numbers(sweep, results);
  write_fiber_table(sweep, results);
  write_failures(sweep, results);
}

}  // namespace skein
