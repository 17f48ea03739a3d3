#include <skein/core/error.hpp>
#include <skein/model/background_flow.hpp>
#include <skein/model/linear_flow.hpp>

namespace skein {
namespace {

class StillFluid : public BackgroundFlow {
 public:
  void add_velocity(double, const ConstVectors&, const Vectors&) const override {}
  std::string describe() const override { return "fluid at rest"; }
};

}  // namespace

std::unique_ptr<BackgroundFlow> make_background_flow(const FlowConfig& config) {
  if (config.kind == "none") return std::make_unique<StillFluid>();
  if (config.kind == "shear") return std::make_unique<LinearFlow>(make_shear_gradient(config.rate), Vec3{});
  throw Error(ExitCode::scene_error, "flow.kind = \"" + config.kind + "\" is not known: use \"shear\" or \"none\"");
}

}  // namespace skein
