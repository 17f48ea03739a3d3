#pragma once

#include <skein/solvers/right_hand_side.hpp>

#include <string>

namespace skein {

/// Passes everything on to another right-hand side: for classes that watch one or change what it does.
class RightHandSideDecorator : public RightHandSide {
 public:
  void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) override {
    inner_.compute_velocity(time, position, velocity);
  }
  std::string find_fault(const ConstVectors& position) const override { return inner_.find_fault(position); }
  void seek_fault(const ConstVectors& position) override { inner_.seek_fault(position); }
  void project(const Vectors& position) override { inner_.project(position); }
  void begin_step() override { inner_.begin_step(); }
  void end_step() noexcept override { inner_.end_step(); }
  std::int64_t evaluations() const override { return inner_.evaluations(); }
  void visit_memory(MemoryVisitor& visitor) override { inner_.visit_memory(visitor); }
  const TimeCourse& time_course() const override { return inner_.time_course(); }
  NodeVectors& vectors() override { return inner_.vectors(); }
  Linearization* linearization() override { return inner_.linearization(); }

 protected:
  /// @param inner  must outlive the object
  explicit RightHandSideDecorator(RightHandSide& inner) : inner_(inner) {}

  RightHandSide& inner_;
};

}  // namespace skein
