#pragma once

#include <skein/physics/background_flow.hpp>

#include <vector>

namespace skein {

struct FlowTerms;

/// The sum of the flows that a scene names, each with its own course in time.
class SceneFlow final : public BackgroundFlow {
 public:
  /// @throws Error(internal) for a kind without a row in the table of flows
  explicit SceneFlow(const std::vector<FlowConfig>& flows);

  void add_velocity(double time, const ConstVectors& position, const Vectors& velocity) const override;
  void compute_velocity(double time, const ConstVectors& position, const Vectors& velocity) const override;
  VelocityGradient gradient(double time, Vec3 position) const override;
  double typical_rate() const override;
  double time_scale() const override;
  void add_course(TimeCourse& course) const override;
  std::string describe() const override;

  /// True where no flow changes with time.
  bool is_steady() const;

  /// The flows at one moment, as kernels take them: as many as one launch adds up in each.
  std::vector<FlowTerms> make_terms(double time) const;

 private:
  std::vector<FlowConfig> flows_;  ///< without those at rest
};

/// r(t) of a flow: its rate, its oscillation, and its rise and fall, which are smooth over `ramp`. 1 / time
double compute_rate(const FlowConfig& flow, double time);

}  // namespace skein
