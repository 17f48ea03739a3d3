#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

using CsvRow = std::vector<std::string>;

/// Rows as comma-separated text (RFC 4180, lines end in '\n' alone): cells that hold a comma, a quote or a line break
/// are quoted. The file appears whole or not at all. @throws Error(io_error)
void write_csv_rows(const std::filesystem::path& path, const std::vector<CsvRow>& rows);

}  // namespace skein
