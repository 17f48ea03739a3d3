#pragma once

#include <skein/core/time_method.hpp>
#include <skein/solvers/control_options.hpp>
#include <skein/solvers/step_costs.hpp>

#include <string>

namespace skein {

/// Which method is expected to do with the least work, and why.
struct MethodSelection {
  TimeMethod method;
  std::string reason;  ///< one line with the numbers that decided
};

/// Of RKC2 and of TR-BDF2. @param spectral_radius  1 / time
ExpectedStep expect_stabilized_step(const ControlOptions& options, double spectral_radius);
ExpectedStep expect_implicit_step(const ControlOptions& options, double spectral_radius,
                                  const PreconditionerCost& preconditioner);

MethodSelection select_method(const ControlOptions& options, double spectral_radius,
                              const PreconditionerCost& preconditioner);

/// RKC2, whatever the stiffness. @param why  completes "..., and ..." behind what its steps take
MethodSelection select_explicit_method(const ControlOptions& options, double spectral_radius, const std::string& why);

}  // namespace skein
