#pragma once

#include <skein/io/trajectory.hpp>
#include <skein/physics/physics.hpp>
#include <skein/scene/scene_config.hpp>

#include "runs/run_analysis.hpp"

#include <functional>
#include <utility>
#include <vector>

namespace skein {

/// Measures frames, one after the other in the order of their times. Needs Kokkos.
class RunAnalyzer {
 public:
  using GradientAt = std::function<VelocityGradient(Vec3)>;

  /// @param physics      of the scene, or what takes its place; must outlive the analyzer
  /// @param gradient     of the flow at a place, at its full rates: what angles and signs refer to
  /// @param with_forces  also springs and fluid: one evaluation of the mobility for each frame
  RunAnalyzer(const SceneConfig& scene, const Physics& physics, GradientAt gradient, bool with_forces);

  void add(const Frame& frame);
  RunAnalysis take() { return std::move(analysis_); }

 private:
  void begin_histories(const Frame& frame);

  const Physics& physics_;
  GradientAt gradient_;
  RunAnalysis analysis_;
  std::vector<Vec3> before_;  ///< centrelines of the frame before
};

}  // namespace skein
