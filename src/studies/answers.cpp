#include "studies/answers.hpp"

#include <skein/analysis/centreline.hpp>
#include <skein/core/error.hpp>

#include "studies/contact_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace skein {
namespace {

constexpr double no_answer = std::numeric_limits<double>::infinity();

/// The point of a fiber at a share of its length, by the cubic through the four nearest sections.
Vec3 find_point(const Fiber& fiber, const std::span<const Vec3> centreline, const double share) {
  const int n = fiber.config.sections;
  const double place = share * n - 0.5;  // section s stands at s + 1/2 spacings
  const int n_points = std::min(n, 4);
  const int first = std::clamp(static_cast<int>(std::floor(place)) - (n_points - 1) / 2, 0, n - n_points);
  Vec3 point;
  for (int i = first; i < first + n_points; ++i) {
    double weight = 1.0;
    for (int j = first; j < first + n_points; ++j)
      if (j != i) weight *= (place - j) / (i - j);
    point = point + weight * centreline[i];
  }
  return point;
}

double compare_shapes(const Pilot& run, const Pilot& better, const std::size_t f) {
  const Fiber &one = run.analysis.fibers[f], &other = better.analysis.fibers[f];
  constexpr int n_places = 64;
  const double margin = 0.5 * std::max(one.spacing(), other.spacing()) / other.length();
  const std::size_t n_frames = std::min(run.centreline.size(), better.centreline.size());
  double largest = 0.0;
  for (std::size_t frame = 0; frame < n_frames; ++frame)
    for (int i = 0; i <= n_places; ++i) {
      const double share = margin + (1.0 - 2.0 * margin) * i / n_places;
      const Vec3 a = find_point(one, centreline_of(one, run.centreline[frame]), share);
      const Vec3 b = find_point(other, centreline_of(other, better.centreline[frame]), share);
      largest = std::max(largest, norm(a - b));
    }
  return largest / other.length();
}

double compare_numbers(const double found, const double better) {
  return better == 0.0 ? std::abs(found) : std::abs(found / better - 1.0);
}

double compare_lists(const std::vector<double>& found, const std::vector<double>& better) {
  double largest = found.empty() == better.empty() ? 0.0 : no_answer;
  for (std::size_t i = 0; i < std::min(found.size(), better.size()); ++i)
    largest = std::max(largest, compare_numbers(found[i], better[i]));
  return largest;
}

/// True where folded ends travel at one speed, and by more than the fold is wide; in a vortex they may come and go, in
/// a U-turn they stay where they are.
bool snakes(const FiberSummary& summary) {
  if (!summary.snaking) return false;
  const Snaking& snaking = *summary.snaking;
  constexpr double least_determination = 0.95;
  const double travelled = std::abs(snaking.speed) * (snaking.end - snaking.begin);
  return snaking.determination >= least_determination && travelled >= snaking.hook_radius;
}

/// A fiber's numbers of one kind; none where it has no answer.
std::vector<double> list_values(const FiberSummary& summary, const Question question) {
  switch (question) {
    case Question::half_period:
      return summary.half_periods;
    case Question::hook_radius:
      return snakes(summary) ? std::vector<double>{summary.snaking->hook_radius} : std::vector<double>{};
    case Question::snaking_speed:
      return snakes(summary) ? std::vector<double>{summary.snaking->speed} : std::vector<double>{};
    case Question::curvature_max:
      return {summary.curvature_max};
    case Question::shape:
    case Question::contact:
      break;
  }
  return {};
}

}  // namespace

const std::vector<Question>& list_questions() {
  static const std::vector<Question> all{Question::shape,         Question::half_period,   Question::hook_radius,
                                         Question::snaking_speed, Question::curvature_max, Question::contact};
  return all;
}

const char* name_of(const Question question) {
  switch (question) {
    case Question::shape:
      return "shape";
    case Question::half_period:
      return "half_period";
    case Question::hook_radius:
      return "hook_radius";
    case Question::snaking_speed:
      return "snaking_speed";
    case Question::curvature_max:
      return "curvature_max";
    case Question::contact:
      break;
  }
  return "contact";
}

Question find_question(const std::string& name) {
  std::vector<std::string> names;
  for (const Question question : list_questions()) {
    if (name == name_of(question)) return question;
    names.emplace_back(name_of(question));
  }
  throw Error(ExitCode::usage,
              fmt::format("--for: '{}' is nothing that is compared; there are {}", name, fmt::join(names, ", ")));
}

std::vector<AnswerError> compare_answers(const Pilot& run, const Pilot& better, const std::vector<Question>& asked) {
  std::vector<AnswerError> errors;
  for (const Question question : asked) {
    if (question == Question::contact) {
      const ContactRecord found = record_contact(run.analysis), known = record_contact(better.analysis);
      errors.push_back(
          {question, found.has_crossed() || known.has_crossed() ? no_answer : std::abs(found.depth - known.depth)});
      continue;
    }
    std::optional<double> largest;
    for (std::size_t f = 0; f < better.analysis.fibers.size(); ++f) {
      if (question == Question::shape) {
        largest = std::max(largest.value_or(0.0), compare_shapes(run, better, f));
        continue;
      }
      const auto found = list_values(run.analysis.histories[f].summarize(), question),
                 known = list_values(better.analysis.histories[f].summarize(), question);
      if (!found.empty() || !known.empty()) largest = std::max(largest.value_or(0.0), compare_lists(found, known));
    }
    if (largest) errors.push_back({question, *largest});
  }
  return errors;
}

double find_largest_error(const std::vector<AnswerError>& errors, Question* worst) {
  double largest = 0.0;
  for (const AnswerError& error : errors)
    if (error.error >= largest) {
      largest = error.error;
      if (worst != nullptr) *worst = error.question;
    }
  return largest;
}

}  // namespace skein
