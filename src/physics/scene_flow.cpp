#include <skein/core/error.hpp>
#include <skein/core/smooth_step.hpp>
#include <skein/physics/flow_summary.hpp>
#include <skein/physics/scene_flow.hpp>

#include "kernels/flow_gradient.hpp"
#include "kernels/flow_velocity.hpp"
#include "physics/flow_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// 0 before `start`, 1 after `start + ramp`.
double rise(const double time, const double start, const double ramp) {
  if (time < start) return 0.0;
  return time >= start + ramp ? 1.0 : smooth_step((time - start) / ramp);
}

bool keeps_rate(const FlowConfig& flow) {
  return flow.angular_frequency == 0.0 && flow.phase == 0.0 && flow.start == 0.0 && flow.stop == 0.0 &&
         flow.ramp == 0.0;
}

std::string describe_course(const FlowConfig& flow) {
  std::string text = fmt::format("{:g}", flow.rate);
  if (flow.angular_frequency != 0.0 || flow.phase != 0.0)
    text += fmt::format(" cos({:g} t{})", flow.angular_frequency,
                        flow.phase == 0.0 ? "" : fmt::format(" {:+g} degrees", flow.phase));
  if (flow.start > 0.0) text += fmt::format(" from t = {:g}", flow.start);
  if (flow.stop > 0.0) text += fmt::format(" to t = {:g}", flow.stop);
  if (flow.ramp > 0.0) text += fmt::format(", rising and falling within {:g}", flow.ramp);
  return text;
}

FlowTerm make_term(const FlowConfig& flow, const double time) {
  return row_of(flow.kind).make_term(flow, compute_rate(flow, time));
}

void add_gradient(const FlowTerm& term, const Vec3 position, VelocityGradient& sum) {
  const GradientRows part = gradient_of(term, position);
  const Vec3 rows[3] = {part.x, part.y, part.z};
  for (std::size_t i = 0; i < 3; ++i) {
    sum[i][0] += rows[i].x;
    sum[i][1] += rows[i].y;
    sum[i][2] += rows[i].z;
  }
}

std::string describe_flow(const FlowConfig& flow) {
  const FlowRow& row = row_of(flow.kind);
  if (keeps_rate(flow)) return row.describe_velocity(flow, fmt::format("{:g}", flow.rate));
  return row.describe_velocity(flow, "r") + ", r = " + describe_course(flow);
}

}  // namespace

double compute_rate(const FlowConfig& flow, const double time) {
  if (keeps_rate(flow)) return flow.rate;
  const double on = rise(time, flow.start, flow.ramp);
  const double off = flow.stop > 0.0 ? rise(time, flow.stop, flow.ramp) : 0.0;
  return flow.rate * on * (1.0 - off) * std::cos(flow.angular_frequency * time + flow.phase * std::numbers::pi / 180.0);
}

SceneFlow::SceneFlow(const std::vector<FlowConfig>& flows) {
  for (const FlowConfig& flow : flows)
    if (!row_of(flow.kind).is_at_rest()) flows_.push_back(flow);
}

void SceneFlow::add_velocity(const double time, const ConstVectors& position, const Vectors& velocity) const {
  SKEIN_REQUIRE(position.extent(0) == velocity.extent(0), "positions and velocities differ in number");
  for (const FlowTerms& terms : make_terms(time)) add_flow_velocity<ExecSpace>(ExecSpace(), terms, position, velocity);
}

void SceneFlow::compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) const {
  std::vector<FlowTerms> batches = make_terms(time);
  if (batches.empty()) batches.emplace_back();
  compute_flow_velocity<ExecSpace>(ExecSpace(), batches.front(), position, velocity);
  for (std::size_t b = 1; b < batches.size(); ++b)
    add_flow_velocity<ExecSpace>(ExecSpace(), batches[b], position, velocity);
}

std::vector<FlowTerms> SceneFlow::make_terms(const double time) const {
  std::vector<FlowTerms> batches;
  for (const FlowConfig& flow : flows_) {
    if (batches.empty() || batches.back().n_terms == FlowTerms::n_allowed) batches.emplace_back();
    FlowTerms& terms = batches.back();
    terms.term[terms.n_terms++] = make_term(flow, time);
  }
  return batches;
}

bool SceneFlow::is_steady() const { return std::all_of(flows_.begin(), flows_.end(), keeps_rate); }

VelocityGradient SceneFlow::gradient(const double time, const Vec3 position) const {
  VelocityGradient sum{};
  for (const FlowConfig& flow : flows_) add_gradient(make_term(flow, time), position, sum);
  return sum;
}

double SceneFlow::typical_rate() const {
  double rate = 0.0;
  for (const FlowConfig& flow : flows_) rate += row_of(flow.kind).deformation * std::abs(flow.rate);
  return rate;
}

double SceneFlow::time_scale() const {
  double motion = 0.0;
  for (const FlowConfig& flow : flows_) motion += row_of(flow.kind).motion * std::abs(flow.rate);
  return motion > 0.0 ? 1.0 / motion : infinity;
}

// The sums are those of rise(): a break is the first moment of what comes after.
void SceneFlow::add_course(TimeCourse& course) const {
  for (const FlowConfig& flow : flows_) {
    if (flow.rate == 0.0) continue;
    const double end = flow.stop > 0.0 ? flow.stop + flow.ramp : infinity;
    course.add_piece(flow.start, end);
    course.add_ramp(flow.start, flow.start + flow.ramp);
    if (flow.stop > 0.0) course.add_ramp(flow.stop, end);
    if (flow.angular_frequency != 0.0)
      course.add_oscillation(flow.start, end, 2.0 * std::numbers::pi / std::abs(flow.angular_frequency));
  }
}

std::string SceneFlow::describe() const {
  std::string text;
  for (const FlowConfig& flow : flows_) text += (text.empty() ? "" : " + ") + describe_flow(flow);
  return text.empty() ? "fluid at rest" : text;
}

std::unique_ptr<BackgroundFlow> make_background_flow(const std::vector<FlowConfig>& flows) {
  return std::make_unique<SceneFlow>(flows);
}

VelocityGradient compute_typical_gradient(const std::vector<FlowConfig>& flows, const Vec3 position) {
  VelocityGradient sum{};
  for (const FlowConfig& flow : flows)
    if (const FlowRow& row = row_of(flow.kind); !row.is_at_rest())
      add_gradient(row.make_term(flow, flow.rate), position, sum);
  return sum;
}

FlowSummary summarize_flow(const std::vector<FlowConfig>& flows) {
  const SceneFlow flow(flows);
  return {flow.typical_rate(), flow.time_scale(), flow.describe()};
}

}  // namespace skein
