#include <skein/core/json.hpp>

#include "studies/plan.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

std::string in_percent(const double error) {
  if (!std::isfinite(error)) return std::isnan(error) ? "unknown" : "no answer";
  return fmt::format("{:.2g} %", 100.0 * error);
}

bool knows_contact(const Candidate& candidate) {
  return candidate.contact.has_crossed() || candidate.contact.depth > 0.0;
}

std::string in_seconds(const double seconds) { return seconds > 0.0 ? fmt::format("{:.3g} s", seconds) : "unknown"; }

}  // namespace

std::string explain_choice(const Plan& plan, const PlanRequest& request) {
  const double percent = 100.0 * request.tolerance;
  if (plan.chosen >= 0) {
    const Candidate& chosen = plan.candidates[plan.chosen];
    std::string text = fmt::format("{} is the cheapest whose answers stay within {:g} %",
                                   describe_rung(chosen.nodes_per_section), percent);
    if (plan.is_by_table) return text + ", by the table of convergence, which has this fiber";
    if (!chosen.found.empty()) text += ", by the difference from " + describe_rung(chosen.compared_with);
    return text;
  }
  const ContactRecord& contact = plan.candidates.back().contact;
  const bool asks_contact =
      std::find(request.asked.begin(), request.asked.end(), Question::contact) != request.asked.end();
  if (contact.has_crossed() || (asks_contact && contact.depth > request.tolerance))
    return fmt::format("no rung is within {:g} %: {} with the finest, too", percent, describe_contact(contact));
  Question worst = Question::shape;
  double largest = 0.0;
  for (const Candidate& candidate : plan.candidates)
    if (!candidate.found.empty()) largest = find_largest_error(candidate.found, &worst);
  return plan.seconds >= request.max_seconds
             ? fmt::format("no rung was shown to be within {:g} % in {:g} s of pilot runs: give them more time",
                           percent, request.max_seconds)
             : fmt::format("no rung is within {:g} %: {} still differs by {:.2g} % between the finest two", percent,
                           name_of(worst), 100.0 * largest);
}

std::string describe_plan(const Plan& plan, const PlanRequest& request) {
  std::string text = fmt::format("{:<18} {:>9} {:>12} {:>12}  {}\n", "rung", "nodes", "error", "wall time", "verdict");
  for (const Candidate& candidate : plan.candidates) {
    text +=
        fmt::format("{:<18} {:>9} {:>12} {:>12}  {}\n", describe_rung(candidate.nodes_per_section).c_str(),
                    candidate.n_nodes, in_percent(candidate.error), in_seconds(candidate.seconds), candidate.verdict);
    for (const AnswerError& found : candidate.found)
      text += fmt::format("    {} differs by {} from {}\n", name_of(found.question), in_percent(found.error),
                          describe_rung(candidate.compared_with));
    if (knows_contact(candidate) && candidate.verdict != describe_contact(candidate.contact))
      text += fmt::format("    {}\n", describe_contact(candidate.contact));
  }
  text += fmt::format("steps: time.tolerance {:.3g}, which changes answers by {}\n", plan.time_tolerance,
                      in_percent(plan.time_error));
  if (!plan.variants.empty()) text += fmt::format("faster than the scene's own: {}\n", plan.variants);
  if (plan.pilot_end < plan.end)
    text += fmt::format(
        "pilots ran to t = {:.4g} of {:.4g}: errors are taken to grow as they did, and nothing is known "
        "of what begins later\n",
        plan.pilot_end, plan.end);
  text += plan.known_contact + "\n";
  text += fmt::format("{}; planned in {:.3g} s for {:g} %\n", plan.reason, plan.seconds, 100.0 * request.tolerance);
  return text;
}

std::string describe_plan_as_json(const Plan& plan, const PlanRequest& request) {
  JsonWriter json(2);
  json.begin_object().member("tolerance", request.tolerance).key("candidates").begin_array();
  for (const Candidate& candidate : plan.candidates) {
    json.begin_object()
        .member("rung", name_of_rung(candidate.nodes_per_section))
        .member("nodes_per_section", candidate.nodes_per_section)
        .member("nodes", candidate.n_nodes);
    json.member("error", candidate.error).member("seconds", candidate.seconds).member("verdict", candidate.verdict);
    json.member("barred", candidate.is_barred);
    if (!candidate.found.empty()) json.member("compared_with", name_of_rung(candidate.compared_with));
    json.key("differences").begin_object();
    for (const AnswerError& found : candidate.found) json.member(name_of(found.question), found.error);
    json.end_object().key("contact").begin_object().member("depth", candidate.contact.depth);
    json.member("smallest_gap", candidate.contact.smallest_gap).member("first_inside", candidate.contact.first_inside);
    json.member("first_crossing", candidate.contact.first_crossing).end_object().end_object();
  }
  json.end_array().key("chosen");
  if (plan.chosen >= 0) {
    json.value(plan.candidates[plan.chosen].nodes_per_section);
  } else {
    json.null();
  }
  json.member("by_table", plan.is_by_table)
      .member("time_tolerance", plan.time_tolerance)
      .member("time_error", plan.time_error);
  json.member("variants", plan.variants).member("reason", plan.reason);
  json.member("known_contact", plan.known_contact)
      .member("pilot_end", plan.pilot_end)
      .member("end", plan.end)
      .member("seconds", plan.seconds);
  return json.end_object().take() + "\n";
}

}  // namespace skein
