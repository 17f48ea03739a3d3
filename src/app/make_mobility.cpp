#include "app/make_mobility.hpp"

#include <skein/hydro/direct_mobility.hpp>

namespace skein {

std::unique_ptr<Mobility> make_mobility(const SceneConfig& scene) {
  const auto precision = scene.hydrodynamics.precision == "single" ? Precision::in_single : Precision::in_double;
  return std::make_unique<DirectMobility>(scene.fluid.viscosity, precision);
}

}  // namespace skein
