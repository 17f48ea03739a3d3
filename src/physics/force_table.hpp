#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/physics/force.hpp>
#include <skein/scene/scene_config.hpp>

#include <memory>
#include <vector>

namespace skein {

using ForceList = std::vector<std::unique_ptr<Force>>;

// Every kind of force: what a scene asks for of it is appended to the list, or nothing. A new kind is a source of its
// own, a line here and a row in physics.cpp.
void append_springs(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_bending(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_shear_couple(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_repulsion(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_gravity(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_tethers(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_torques(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_undulations(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);
void append_clamps(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces);

/// The forces of a scene in the order of the table.
ForceList make_forces(const SceneConfig& scene, const std::vector<Fiber>& fibers);

}  // namespace skein
