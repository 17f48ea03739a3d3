#include "runs/cost_card.hpp"

#include <skein/core/duration.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace skein {
namespace {

std::string describe_errors(const ErrorRecord& errors) {
  if (errors.n_checks == 0) return "never checked";
  return fmt::format("error {:.2g} at most in {} check{} against direct sums, {} above the tolerance", errors.largest,
                     errors.n_checks, errors.n_checks == 1 ? "" : "s", errors.n_misses);
}

}  // namespace

std::string describe_cost(const CostCard& card) {
  const double seconds = std::max(card.seconds, 1e-9);
  const auto share = [seconds](const double part) { return 100.0 * part / seconds; };
  const double other = seconds - card.fluid - card.springs_and_flow - card.integrator - card.observables - card.output;
  std::string text = fmt::format("cost: {:.3f} s wall time ({})", card.seconds, format_duration(card.seconds));
  if (card.seconds_before > 0.0) text += fmt::format(", after {:.3f} s before it was resumed", card.seconds_before);
  text += fmt::format("; {} steps ({} attempts rejected), {} evaluations of {:.3g} ms\n", card.steps, card.rejected,
                      card.evaluations,
                      1e3 * (card.fluid + card.springs_and_flow) / std::max<double>(1.0, card.evaluations));
  text += fmt::format("  fluid sum         {:6.2f} %   {:.3g} pairs/s\n", share(card.fluid),
                      card.fluid > 0.0 ? card.pairs / card.fluid : 0.0);
  text += fmt::format("  springs, flow     {:6.2f} %\n", share(card.springs_and_flow));
  text += fmt::format("  time integration  {:6.2f} %\n", share(card.integrator));
  text += fmt::format("  observables       {:6.2f} %\n", share(card.observables));
  text += fmt::format("  frames, checkpoints {:4.2f} %   {:.2f} MB\n", share(card.output), card.megabytes);
  text += fmt::format("  rest              {:6.2f} %\n", share(std::max(other, 0.0)));
  text += fmt::format("  error: {}; velocities: {}",
                      card.largest_error > 0.0
                          ? fmt::format("at most {:.2g} of the tolerance in a step, {:.2g} L estimated in all",
                                        card.largest_error, card.estimated_error)
                          : std::string("not estimated by this integrator"),
                      card.mobility);
  if (card.direct_seconds > 0.0)
    text +=
        fmt::format("\n  {}; {} of all evaluations were no direct sums, which would have taken about {} instead of {}",
                    describe_errors(card.velocity_errors), card.velocity_errors.n_approximate,
                    format_duration(card.direct_seconds), format_duration(card.fluid));
  return text;
}

}  // namespace skein
