#pragma once

#include <skein/arrays/types.hpp>
#include <skein/solvers/right_hand_side.hpp>

#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace skein {

/// dx_i/dt = velocity(t, i, x_i), each node by itself, on the host: equations whose exact solutions are known.
class PointwiseRightHandSide final : public RightHandSide {
 public:
  using Velocity = std::function<Vec3(double time, int node, Vec3 x)>;

  /// @param range  positions farther out than this are at fault
  explicit PointwiseRightHandSide(Velocity velocity, const double range = 1e100)
      : velocity_(std::move(velocity)), range_(range) {}

  void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) override {
    ++evaluations_;
    std::vector<Vec3> list = to_host(position);
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = velocity_(time, static_cast<int>(i), list[i]);
    Kokkos::deep_copy(velocity, to_device("test::velocity", list));
  }

  std::string find_fault(const ConstVectors& position) const override {
    const std::vector<Vec3> list = to_host(position);
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!(norm(list[i]) < range_)) return "node " + std::to_string(i) + " is out of range";
    return {};
  }

  std::int64_t evaluations() const override { return evaluations_; }
  const TimeCourse& time_course() const override { return course; }

  TimeCourse course;  ///< what the velocity is said to do

 private:
  Velocity velocity_;
  double range_;
  std::int64_t evaluations_ = 0;
};

/// Decay at three rates per node: rate(3 i + c) for component c of node i.
inline PointwiseRightHandSide make_decay(const std::function<double(int)>& rate) {
  return PointwiseRightHandSide([rate](double, const int node, const Vec3 x) {
    return Vec3{-rate(3 * node) * x.x, -rate(3 * node + 1) * x.y, -rate(3 * node + 2) * x.z};
  });
}

}  // namespace skein
