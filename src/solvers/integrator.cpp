#include <skein/solvers/integrator.hpp>

#include <algorithm>

namespace skein {

namespace {

/// Lets rank 0 have what others have parts of.
class Gatherer final : public MemoryVisitor {
 public:
  void number(std::string_view, double&) override {}
  void integer(std::string_view, std::int64_t&) override {}
  void vectors(std::string_view, const Vectors&) override {}
};

class StepScope {
 public:
  explicit StepScope(RightHandSide& rhs) : rhs_(rhs) { rhs_.begin_step(); }
  StepScope(const StepScope&) = delete;
  StepScope& operator=(const StepScope&) = delete;
  ~StepScope() { rhs_.end_step(); }

 private:
  RightHandSide& rhs_;
};

}  // namespace

void Integrator::gather_memory() {
  Gatherer gatherer;
  visit_memory(gatherer);
}

StepReport Integrator::advance(State& state, const double end) {
  before_.take(*this, rhs_);
  const StepScope scope(rhs_);
  try {
    return take_step(state, std::min(end, rhs_.time_course().next_break(state.time)));
  } catch (...) {
    before_.bring_back(*this, rhs_);
    throw;
  }
}

}  // namespace skein
