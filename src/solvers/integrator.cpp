#include <skein/solvers/integrator.hpp>

#include <algorithm>

namespace skein {

StepReport Integrator::advance(State& state, const double end) {
  before_.take(*this, rhs_);
  try {
    return take_step(state, std::min(end, rhs_.time_course().next_break(state.time)));
  } catch (...) {
    before_.bring_back(*this, rhs_);
    throw;
  }
}

}  // namespace skein
