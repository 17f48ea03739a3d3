#pragma once

#include <skein/arrays/memory_snapshot.hpp>
#include <skein/core/time_method.hpp>
#include <skein/solvers/right_hand_side.hpp>
#include <skein/solvers/step_costs.hpp>

#include <cstdint>
#include <string>

namespace skein {

/// The nodes at one moment. Lives on the device from the first step to the last.
struct State {
  double time = 0.0;
  std::int64_t step = 0;  ///< accepted steps so far
  Vectors position;       ///< [n_nodes, 3], length
};

/// What one accepted step did, for the series and the log.
struct StepReport {
  double dt = 0.0;               ///< time advanced
  double error = 0.0;            ///< estimated local error over tolerance; 0 where the method has no estimate
  double local_error = 0.0;      ///< that error, root mean square over nodes, length
  double spectral_radius = 0.0;  ///< estimate in use, 1 / time; 0 where none is made
  int stages = 1;
  int rejected = 0;       ///< attempts thrown away before this step
  std::string rejection;  ///< why the last of them was
};

/// Advances a State by one step of its own choice.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Takes one accepted step that does not pass `end`, nor a time at which the right-hand side is not smooth, replacing
  /// state.time, state.step and state.position.
  /// @throws Error(numerical) naming node and time when positions are no longer finite, when they left the model's
  ///         range, or when the step fell below its minimum. After this and any other exception the state and what this
  ///         object and the right-hand side remember are those before the call: callers have nothing to undo.
  StepReport advance(State& state, double end);

  /// Positions at a time inside the last accepted step, until the next call of advance: output at exact times does not
  /// change the steps taken.
  virtual void interpolate(double time, const Vectors& position) const = 0;

  /// All that the next step depends on besides the state: what a restart needs, and no more.
  virtual void visit_memory(MemoryVisitor& visitor) = 0;

  /// What a scene calls this method; of an integrator that was chosen, the one that was.
  virtual TimeMethod method() const = 0;

  /// About, where the equations are as stiff as that. @param spectral_radius  1 / time
  virtual ExpectedStep expect_step(double spectral_radius) const = 0;

  /// One line for the first lines of a run.
  virtual std::string describe() const = 0;

 protected:
  /// @param rhs  must outlive the integrator
  explicit Integrator(RightHandSide& rhs) : rhs_(rhs) {}

  /// The step itself; it may be as long as the right-hand side's time course allows. The state is changed only once the
  /// step is accepted.
  virtual StepReport take_step(State& state, double end) = 0;

  /// Before the state is changed: where ranks own nodes, rank 0 has all that visit_memory shows from here on, so that
  /// it can save it when another rank is lost.
  void gather_memory();

  RightHandSide& rhs_;

 private:
  MemorySnapshot before_;
};

}  // namespace skein
