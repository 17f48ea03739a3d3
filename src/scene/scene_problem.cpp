#include <skein/scene/scene_problem.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace skein {
namespace {

constexpr std::size_t n_problems_shown = 100;

std::string make_heading(const std::string& kind, const std::string& file, const std::size_t n_problems) {
  return fmt::format("{} in the {} {}", n_problems == 1 ? "1 problem" : fmt::format("{} problems", n_problems), kind,
                     file);
}

auto order(const Problem& problem) {
  return std::tie(problem.where.override_index, problem.where.line, problem.where.column, problem.message);
}

}  // namespace

std::string Problem::describe() const {
  std::string place = where.source;
  if (where.line > 0) place += fmt::format(":{}:{}", where.line, where.column);
  return place + ": " + message + (key_doc.empty() ? "" : "\n    " + key_doc);
}

void sort_problems(std::vector<Problem>& problems) {
  std::sort(problems.begin(), problems.end(), [](const auto& a, const auto& b) { return order(a) < order(b); });
  const auto same = [](const auto& a, const auto& b) { return order(a) == order(b); };
  problems.erase(std::unique(problems.begin(), problems.end(), same), problems.end());
}

std::string describe_problems(const std::vector<Problem>& problems) {
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), n_problems_shown); ++i) {
    text += (i > 0 ? "\n" : "") + problems[i].describe();
  }
  if (problems.size() > n_problems_shown) text += fmt::format("\nand {} more", problems.size() - n_problems_shown);
  return text;
}

SceneError::SceneError(const std::string& file, std::vector<Problem> problems, const std::string& kind)
    : Error(ExitCode::scene_error, make_heading(kind, file, problems.size()) + "\n" + describe_problems(problems)),
      problems_(std::move(problems)) {}

}  // namespace skein
