#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/make_mobility.hpp>
#include <skein/physics/mobility_choice.hpp>

namespace skein {

std::unique_ptr<Mobility> make_mobility(const SceneConfig& scene) {
  const MobilityChoice choice = choose_mobility(scene);
  if (choice.is_direct) return std::make_unique<DirectMobility>(scene.fluid.viscosity, choice.precision);
  return std::make_unique<FmmMobility>(scene.fluid.viscosity, choice.fmm);
}

}  // namespace skein
