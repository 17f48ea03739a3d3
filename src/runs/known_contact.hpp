#pragma once

#include <skein/scene/scene_config.hpp>

#include <string>
#include <vector>

namespace skein {

/// What runs have shown of one fiber that starts straight along a shear: from when on its ends are pressed into its
/// sides. By `skein bench contact`; docs/analysis.md has the whole table.
struct ContactRow {
  double aspect_ratio;   ///< length / radius
  double stiffness;      ///< EI at equilibrium / (viscosity rate radius^4)
  int coarsest, finest;  ///< nodes on a section of the models that were run, 1 being the chain
  double first_inside;   ///< rate * time when surfaces were first inside of each other; infinite: never
  double shown;          ///< rate * time to which it was followed
};
const std::vector<ContactRow>& list_known_contacts();

/// The rows that speak of a scene: one fiber, alone with a steady shear along which it lies, of nearly that length and
/// stiffness, or shorter or stiffer than one that never met itself. None where nothing is known, or a repulsion changes
/// what happens.
/// @param scene  its fibers are placed
std::vector<ContactRow> find_known_contacts(const SceneConfig& scene);

/// What is known of contact in a scene before it has run: a line without its end.
std::string describe_known_contact(const SceneConfig& scene);

/// What helps where surfaces come too near, a clause.
std::string advise_on_contact(bool has_repulsion);

}  // namespace skein
