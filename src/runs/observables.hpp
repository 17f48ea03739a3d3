#pragma once

#include <skein/analysis/regime.hpp>
#include <skein/io/trajectory.hpp>
#include <skein/physics/physics.hpp>
#include <skein/solvers/integrator.hpp>

#include <cstdint>
#include <vector>

namespace skein {

/// Positions with what is derived from them. @param step  accepted ones before `time`
Frame make_frame(const Physics& physics, std::int64_t step, double time, const ConstVectors& position);

/// The regime of each fiber. @returns [n_fibers]
std::vector<Regime> classify_frame(const std::vector<Fiber>& fibers, const Frame& frame);

/// The small numbers of the step that led to `state`, but for what is counted since the start of the run: evaluations,
/// crossings.
/// @param measures  of the state
StepRecord make_step_record(const Physics& physics, const State& state, const StepReport& report,
                            const StepMeasures& measures);

}  // namespace skein
