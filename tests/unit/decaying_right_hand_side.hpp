#pragma once

#include <skein/solvers/linearization.hpp>

#include "tests/unit/known_solutions.hpp"

namespace skein {

/// A pointwise equation that offers one rate of decay per node as its stiff part; what else is in its derivative, the
/// linearization does not know.
class DecayingRightHandSide final : public RightHandSide, public Linearization {
 public:
  DecayingRightHandSide(PointwiseRightHandSide::Velocity velocity, std::vector<double> rate, const double range = 1e100)
      : equation_(std::move(velocity), range), rate_(std::move(rate)) {}

  void compute_velocity(const double time, const ConstVectors& x, const Vectors& velocity) override {
    equation_.compute_velocity(time, x, velocity);
  }
  std::string find_fault(const ConstVectors& position) const override { return equation_.find_fault(position); }
  std::int64_t evaluations() const override { return equation_.evaluations() + products_; }
  const TimeCourse& time_course() const override { return equation_.course; }
  Linearization* linearization() override { return this; }

  void set_position(double, const ConstVectors&) override {}
  void multiply(const ConstVectors& v, const Vectors& result) override {
    ++products_;
    scale(v, result, [&](const double rate) { return -rate; });
  }
  bool factorize(const ConstVectors&, const double factor) override {
    factor_ = factor;
    ++factorizations;
    return true;
  }
  PreconditionerCost preconditioner_cost() const override { return {3.0, 0.5}; }
  /// Half of what it should know: GMRES has something left to do.
  void precondition(const ConstVectors& v, const Vectors& result) override {
    scale(v, result, [&](const double rate) { return 1.0 / (1.0 + 0.5 * factor_ * rate); });
  }
  std::string describe() const override { return "half the diagonal"; }

  TimeCourse& course() { return equation_.course; }
  int factorizations = 0;

 private:
  template <class Factor>
  void scale(const ConstVectors& v, const Vectors& result, const Factor& factor) {
    std::vector<Vec3> list = to_host(v);
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = factor(rate_[i]) * list[i];
    Kokkos::deep_copy(result, to_device("test::list", list));
  }
  PointwiseRightHandSide equation_;
  std::vector<double> rate_;
  double factor_ = 0.0;
  std::int64_t products_ = 0;
};

}  // namespace skein
