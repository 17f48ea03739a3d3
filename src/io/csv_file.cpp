#include <skein/io/atomic_file.hpp>
#include <skein/io/csv_file.hpp>

namespace skein {
namespace {

std::string quote_if_needed(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

void write_csv_rows(const std::filesystem::path& path, const std::vector<CsvRow>& rows) {
  std::string text;
  for (const CsvRow& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) text += (c == 0 ? "" : ",") + quote_if_needed(row[c]);
    text += '\n';
  }
  write_file_atomically(path, text);
}

}  // namespace skein
