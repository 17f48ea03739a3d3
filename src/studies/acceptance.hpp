#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

enum class Verdict { agrees, differs, not_reached };
const char* name_of(Verdict verdict);

/// One line of a comparison with a published result.
struct AcceptanceRow {
  std::string figure;      ///< "table1", "figure2", ...
  std::string quantity;    ///< what was measured, with its unit
  std::string source;      ///< where the publication says it
  std::string paper;       ///< what it says
  std::string skein;       ///< what came out
  std::string difference;  ///< skein - paper; empty for words
  std::string tolerance;
  Verdict verdict = Verdict::not_reached;
};

/// skein is a number within tolerance of the paper's. NaN is not reached.
AcceptanceRow compare_number(double paper, double skein, double tolerance);
/// skein lies between both. NaN is not reached.
AcceptanceRow compare_range(double low, double high, double skein);
/// Both say the same; an empty word is not reached.
AcceptanceRow compare_word(const std::string& paper, const std::string& skein);

/// Aligned columns and a last line that counts the verdicts.
std::string describe_rows(const std::vector<AcceptanceRow>& rows);
std::string describe_rows_as_json(const std::vector<AcceptanceRow>& rows);

/// @throws Error(io_error)
void write_rows_csv(const std::filesystem::path& path, const std::vector<AcceptanceRow>& rows);

/// The worst of all verdicts.
Verdict worst(const std::vector<AcceptanceRow>& rows);

}  // namespace skein
