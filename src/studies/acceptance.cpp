#include "studies/acceptance.hpp"

#include <skein/core/json_text.hpp>
#include <skein/io/atomic_file.hpp>

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

std::string quote_csv(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

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
  std::string text;
  for (const AcceptanceRow& row : rows) {
    const Cells cells = cells_of(row);
    std::string object;
    for (std::size_t c = 0; c < cells.size(); ++c)
      object += fmt::format("{}{}: {}", c == 0 ? "" : ", ", quote_json(heading[c]), quote_json(cells[c]));
    text += (text.empty() ? "  {" : ",\n  {") + object + "}";
  }
  return "[\n" + text + "\n]\n";
}

void write_rows_csv(const std::filesystem::path& path, const std::vector<AcceptanceRow>& rows) {
  std::string text;
  const auto add = [&](const Cells& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) text += (c == 0 ? "" : ",") + quote_csv(cells[c]);
    text += "\n";
  };
  add(heading);
  for (const AcceptanceRow& row : rows) add(cells_of(row));
  write_file_atomically(path, text);
}

Verdict worst(const std::vector<AcceptanceRow>& rows) {
  if (count(rows, Verdict::differs) > 0) return Verdict::differs;
  return count(rows, Verdict::not_reached) > 0 ? Verdict::not_reached : Verdict::agrees;
}

}  // namespace skein
