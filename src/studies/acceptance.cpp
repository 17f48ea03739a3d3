#include "studies/acceptance.hpp"

#include <skein/core/json.hpp>
#include <skein/io/csv_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace skein {
namespace {

using Cells = std::array<std::string, 8>;

Cells cells_of(const AcceptanceRow& row) {
  return {row.figure,    row.quantity,         row.paper, row.skein, row.difference,
          row.tolerance, name_of(row.verdict), row.source};
}

const Cells heading = {"figure", "quantity", "paper", "skein", "difference", "tolerance", "verdict", "source"};

int count(const std::vector<AcceptanceRow>& rows, const Verdict verdict) {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [&](const AcceptanceRow& row) { return row.verdict == verdict; }));
}

}  // namespace

const char* name_of(const Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::differs:
      return "DIFFERS";
    case Verdict::not_reached:
      break;
  }
  return "not reached";
}

AcceptanceRow compare_number(const double paper, const double skein, const double tolerance) {
  AcceptanceRow row;
  row.paper = fmt::format("{:.5g}", paper);
  row.tolerance = fmt::format("{:.3g}", tolerance);
  if (std::isnan(skein)) return row;
  row.skein = fmt::format("{:.5g}", skein);
  row.difference = fmt::format("{:+.3g}", skein - paper);
  row.verdict = std::abs(skein - paper) <= tolerance ? Verdict::agrees : Verdict::differs;
  return row;
}

AcceptanceRow compare_range(const double low, const double high, const double skein) {
  AcceptanceRow row;
  row.paper = std::isinf(high)  ? fmt::format(">= {:.4g}", low)
              : std::isinf(low) ? fmt::format("<= {:.4g}", high)
                                : fmt::format("{:.4g} .. {:.4g}", low, high);
  row.tolerance = "range";
  if (std::isnan(skein)) return row;
  row.skein = fmt::format("{:.5g}", skein);
  row.verdict = skein >= low && skein <= high ? Verdict::agrees : Verdict::differs;
  return row;
}

AcceptanceRow compare_word(const std::string& paper, const std::string& skein) {
  AcceptanceRow row;
  row.paper = paper;
  row.skein = skein;
  row.tolerance = "same";
  if (!skein.empty()) row.verdict = paper == skein ? Verdict::agrees : Verdict::differs;
  return row;
}

std::string describe_rows(const std::vector<AcceptanceRow>& rows) {
  std::vector<Cells> lines{heading};
  for (const AcceptanceRow& row : rows) lines.push_back(cells_of(row));
  std::array<std::size_t, 8> width{};
  for (const Cells& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  std::string text;
  for (const Cells& line : lines) {
    std::string one;
    for (std::size_t c = 0; c < line.size(); ++c) one += fmt::format("{:<{}}  ", line[c], width[c]);
    text += one.substr(0, one.find_last_not_of(' ') + 1) + "\n";
  }
  return text + fmt::format("{} rows: {} agree, {} differ, {} not reached\n", rows.size(), count(rows, Verdict::agrees),
                            count(rows, Verdict::differs), count(rows, Verdict::not_reached));
}

std::string describe_rows_as_json(const std::vector<AcceptanceRow>& rows) {
  JsonWriter json(/*n_open_levels=*/1);
  json.begin_array();
  for (const AcceptanceRow& row : rows) {
    const Cells cells = cells_of(row);
    json.begin_object();
    for (std::size_t c = 0; c < cells.size(); ++c) json.member(heading[c], cells[c]);
    json.end_object();
  }
  return json.end_array().take() + "\n";
}

void write_rows_csv(const std::filesystem::path& path, const std::vector<AcceptanceRow>& rows) {
  std::vector<CsvRow> lines{{heading.begin(), heading.end()}};
  for (const AcceptanceRow& row : rows) {
    const Cells cells = cells_of(row);
    lines.emplace_back(cells.begin(), cells.end());
  }
  write_csv_rows(path, lines);
}

Verdict worst(const std::vector<AcceptanceRow>& rows) {
  if (count(rows, Verdict::differs) > 0) return Verdict::differs;
  return count(rows, Verdict::not_reached) > 0 ? Verdict::not_reached : Verdict::agrees;
}

}  // namespace skein
