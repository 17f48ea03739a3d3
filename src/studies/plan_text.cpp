#include <skein/core/json.hpp>

#include "studies/plan.hpp"
#include "studies/rung.hpp"

#include <fmt/format.h>

#include <cmath>

namespace skein {
namespace {

std::string in_percent(const double error) {
  if (!std::isfinite(error)) return std::isnan(error) ? "unknown" : "no answer";
  return fmt::format("{:.2g} %", 100.0 * error);
}

std::string name_briefly(const int rung) {
  return rung == rigid_rung ? "rigid" : rung == chain_rung ? "chain" : fmt::format("{}", rung);
}

std::string in_seconds(const double seconds) { return seconds > 0.0 ? fmt::format("{:.3g} s", seconds) : "unknown"; }

}  // namespace

std::string describe_plan(const Plan& plan, const PlanRequest& request) {
  std::string text =
      fmt::format("{:<18} {:>9} {:>12} {:>12}  {}\n", "nodes per section", "nodes", "error", "wall time", "verdict");
  for (const Candidate& candidate : plan.candidates) {
    text +=
        fmt::format("{:<18} {:>9} {:>12} {:>12}  {}\n", name_briefly(candidate.nodes_per_section), candidate.n_nodes,
                    in_percent(candidate.error), in_seconds(candidate.seconds), candidate.verdict);
    for (const AnswerError& found : candidate.found)
      text += fmt::format("    {} differs by {} from the next\n", name_of(found.question), in_percent(found.error));
  }
  text += fmt::format("steps: time.tolerance {:.3g}, which changes answers by {}\n", plan.time_tolerance,
                      in_percent(plan.time_error));
  if (!plan.variants.empty()) text += fmt::format("faster than the scene's own: {}\n", plan.variants);
  if (plan.pilot_end < plan.end)
    text += fmt::format(
        "pilots ran to t = {:.4g} of {:.4g}: errors are taken to grow as they did, and nothing is known "
        "of what begins later\n",
        plan.pilot_end, plan.end);
  if (!plan.contact.empty())
    text +=
        fmt::format("contact: {}. No rung promises anything of surfaces that touch; a [repulsion] keeps them apart\n",
                    plan.contact);
  text += fmt::format("{}; planned in {:.3g} s for {:g} %\n", plan.reason, plan.seconds, 100.0 * request.tolerance);
  return text;
}

std::string describe_plan_as_json(const Plan& plan, const PlanRequest& request) {
  JsonWriter json(2);
  json.begin_object().member("tolerance", request.tolerance).key("candidates").begin_array();
  for (const Candidate& candidate : plan.candidates) {
    json.begin_object().member("nodes_per_section", candidate.nodes_per_section).member("nodes", candidate.n_nodes);
    json.member("error", candidate.error).member("seconds", candidate.seconds).member("verdict", candidate.verdict);
    json.key("differences").begin_object();
    for (const AnswerError& found : candidate.found) json.member(name_of(found.question), found.error);
    json.end_object().end_object();
  }
  json.end_array().key("chosen");
  if (plan.chosen >= 0) {
    json.value(plan.candidates[plan.chosen].nodes_per_section);
  } else {
    json.null();
  }
  json.member("time_tolerance", plan.time_tolerance).member("time_error", plan.time_error);
  json.member("variants", plan.variants).member("contact", plan.contact).member("reason", plan.reason);
  json.member("pilot_end", plan.pilot_end).member("end", plan.end).member("seconds", plan.seconds);
  return json.end_object().take() + "\n";
}

}  // namespace skein
