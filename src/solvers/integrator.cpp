#include <skein/solvers/integrator.hpp>

namespace skein {

StepReport Integrator::advance(State& state, const double end) {
  before_.take(*this, rhs_);
  try {
    return take_step(state, end);
  } catch (...) {
    before_.bring_back(*this, rhs_);
    throw;
  }
}

}  // namespace skein
