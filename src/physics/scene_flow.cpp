#include <skein/core/error.hpp>
#include <skein/physics/flow_summary.hpp>
#include <skein/physics/linear_flow.hpp>
#include <skein/physics/scene_flow.hpp>

#include "kernels/flow_velocity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

/// 0 before `start`, 1 after `start + ramp`; a cubic without kinks in between.
double rise(const double time, const double start, const double ramp) {
  if (time < start) return 0.0;
  if (time >= start + ramp) return 1.0;
  const double share = (time - start) / ramp;
  return share * share * (3.0 - 2.0 * share);
}

bool is_steady(const FlowConfig& flow) {
  return flow.angular_frequency == 0.0 && flow.phase == 0.0 && flow.start == 0.0 && flow.stop == 0.0 &&
         flow.ramp == 0.0;
}

FlowTerm make_linear_term(const VelocityGradient& g, const Vec3 origin) {
  FlowTerm term;
  term.origin = origin;
  term.gradient_x = {g[0][0], g[0][1], g[0][2]};
  term.gradient_y = {g[1][0], g[1][1], g[1][2]};
  term.gradient_z = {g[2][0], g[2][1], g[2][2]};
  return term;
}

FlowTerm make_curved_term(const FlowShape shape, const FlowConfig& flow, const double rate) {
  FlowTerm term;
  term.shape = shape;
  term.origin = flow.center;
  term.rate = rate;
  term.size = flow.size;
  return term;
}

FlowTerm make_term(const FlowConfig& flow, const double rate) {
  if (flow.kind == "shear") return make_linear_term(make_shear_gradient(rate), flow.center);
  if (flow.kind == "planar_extension") return make_linear_term(make_planar_extension_gradient(rate), flow.center);
  if (flow.kind == "uniaxial_extension") return make_linear_term(make_uniaxial_extension_gradient(rate), flow.center);
  if (flow.kind == "rotation") return make_linear_term(make_rotation_gradient(rate), flow.center);
  if (flow.kind == "poiseuille") return make_curved_term(FlowShape::parabolic, flow, rate);
  if (flow.kind == "vortices") return make_curved_term(FlowShape::cellular, flow, rate);
  throw Error(ExitCode::scene_error, "flow.kind = \"" + flow.kind +
                                         "\" is not known: use \"shear\", \"planar_extension\", "
                                         "\"uniaxial_extension\", \"rotation\", \"poiseuille\", \"vortices\" or "
                                         "\"none\"");
}

/// sqrt(2 E : E) at rate 1, where it is largest; E is the symmetric part of the velocity gradient.
double deformation_of(const FlowConfig& flow) {
  if (flow.kind == "rotation") return 0.0;
  if (flow.kind == "planar_extension" || flow.kind == "vortices") return 2.0;
  return flow.kind == "uniaxial_extension" ? std::numbers::sqrt3 : 1.0;
}

/// "x", or "(x - 0.3)" from a center that is not 0.
std::string from_center(const char* name, const double center) {
  if (center == 0.0) return name;
  return fmt::format("({} {} {:g})", name, center > 0.0 ? '-' : '+', std::abs(center));
}

std::string describe_velocity(const FlowConfig& flow, const std::string& r) {
  const std::string x = from_center("x", flow.center.x), y = from_center("y", flow.center.y),
                    z = from_center("z", flow.center.z);
  if (flow.kind == "shear") return fmt::format("shear ({} {}, 0, 0)", r, y);
  if (flow.kind == "planar_extension") return fmt::format("planar extension {} (-{}, {}, 0)", r, x, y);
  if (flow.kind == "uniaxial_extension") return fmt::format("uniaxial extension {} ({}, -{}/2, -{}/2)", r, x, y, z);
  if (flow.kind == "rotation") return fmt::format("rotation {} (-{}, {}, 0)", r, y, x);
  if (flow.kind == "poiseuille")
    return fmt::format("Poiseuille {0} {1:g}/2 (1 - ({2}/{1:g})^2, 0, 0)", r, flow.size, y);
  return fmt::format("vortices {}/k (sin k{} cos k{}, -cos k{} sin k{}, 0), k = pi/{:g}", r, x, y, x, y, flow.size);
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

std::string describe_flow(const FlowConfig& flow) {
  if (is_steady(flow)) return describe_velocity(flow, fmt::format("{:g}", flow.rate));
  return describe_velocity(flow, "r") + ", r = " + describe_course(flow);
}

}  // namespace

double compute_rate(const FlowConfig& flow, const double time) {
  if (is_steady(flow)) return flow.rate;
  const double on = rise(time, flow.start, flow.ramp);
  const double off = flow.stop > 0.0 ? rise(time, flow.stop, flow.ramp) : 0.0;
  return flow.rate * on * (1.0 - off) * std::cos(flow.angular_frequency * time + flow.phase * std::numbers::pi / 180.0);
}

SceneFlow::SceneFlow(const std::vector<FlowConfig>& flows) {
  for (const FlowConfig& flow : flows) {
    if (flow.kind == "none") continue;
    make_term(flow, 0.0);  // throws where the kind is not known
    flows_.push_back(flow);
  }
}

void SceneFlow::add_velocity(const double time, const ConstVectors& position, const Vectors& velocity) const {
  SKEIN_REQUIRE(position.extent(0) == velocity.extent(0), "positions and velocities differ in number");
  for (std::size_t first = 0; first < flows_.size(); first += FlowTerms::n_allowed) {
    FlowTerms terms;
    for (std::size_t f = first; f < flows_.size() && terms.n_terms < FlowTerms::n_allowed; ++f)
      terms.term[terms.n_terms++] = make_term(flows_[f], compute_rate(flows_[f], time));
    add_flow_velocity<ExecSpace>(ExecSpace(), terms, position, velocity);
  }
}

double SceneFlow::typical_rate() const {
  double rate = 0.0;
  for (const FlowConfig& flow : flows_) rate += deformation_of(flow) * std::abs(flow.rate);
  return rate;
}

double SceneFlow::time_scale() const {
  double motion = 0.0, change = 0.0;
  for (const FlowConfig& flow : flows_) {
    if (flow.rate == 0.0) continue;
    motion += std::abs(flow.rate);
    change = std::max(change, std::abs(flow.angular_frequency));
    if (flow.ramp > 0.0) change = std::max(change, 1.0 / flow.ramp);
  }
  const double fastest = std::max(motion, change);
  return fastest > 0.0 ? 1.0 / fastest : std::numeric_limits<double>::infinity();
}

std::string SceneFlow::describe() const {
  std::string text;
  for (const FlowConfig& flow : flows_) text += (text.empty() ? "" : " + ") + describe_flow(flow);
  return text.empty() ? "fluid at rest" : text;
}

std::unique_ptr<BackgroundFlow> make_background_flow(const std::vector<FlowConfig>& flows) {
  return std::make_unique<SceneFlow>(flows);
}

FlowSummary summarize_flow(const std::vector<FlowConfig>& flows) {
  const SceneFlow flow(flows);
  return {flow.typical_rate(), flow.time_scale(), flow.describe()};
}

}  // namespace skein
