#include "run_file_names.hpp"

#include <skein/io/start_name.hpp>

#include <array>
#include <cctype>
#include <string_view>

namespace skein {
namespace {

constexpr std::string_view partial_suffix = ".partial";

std::string_view without_partial(std::string_view name) {
  if (name.ends_with(partial_suffix)) name.remove_suffix(partial_suffix.size());
  return name;
}

}  // namespace

bool is_file_of_a_run(const std::string& name) {
  constexpr std::array<std::string_view, 7> names = {"scene.toml",   "trajectory.h5", "trajectory.xdmf", "run.log",
                                                     "events.jsonl", "STOP",          "OUTPUT_NOW"};
  if (is_start_name(name)) return true;
  for (const std::string_view known : names)
    if (without_partial(name) == known) return true;
  return false;
}

bool is_numbered_file(const std::string& name) {
  std::string_view stem = without_partial(name);
  for (const std::string_view suffix : {".damaged", ".checkpoint", ".h5"})
    if (stem.ends_with(suffix)) stem.remove_suffix(suffix.size());
  if (stem.size() == name.size()) return false;
  for (const char c : stem)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return false;
  return !stem.empty();
}

bool is_table(const std::string& name) {
  const std::string_view whole = without_partial(name);
  return whole == "diagnostics.h5" || whole == "diagnostics.csv";
}

bool is_picture(const std::string& name) {
  constexpr std::array<std::string_view, 7> pictures = {"shapes",  "angle", "curvature", "energy",
                                                        "extrema", "power", "defects"};
  const std::string_view whole = without_partial(name);
  for (const std::string_view suffix : {".png", ".pdf", ".svg"})
    for (const std::string_view picture : pictures)
      if (whole.ends_with(suffix) && whole.substr(0, whole.size() - suffix.size()) == picture) return true;
  return whole == "movie.mp4" || whole == "view.html" || whole == "report.html";
}

bool is_rehearsal(const std::string& name) { return without_partial(name) == "rehearsal"; }

bool is_half_written(const std::string& name) { return name.ends_with(partial_suffix); }

}  // namespace skein
