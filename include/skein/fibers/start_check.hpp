#pragma once

#include <skein/fibers/start_shape.hpp>
#include <skein/scene/scene_file.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace skein {

/// Strain |r/l - 1| of a spring from which on springs do not act as a solid rod: no start may have more, and a run that
/// meets more says so.
inline constexpr double largest_sound_strain = 0.5;

/// Largest |r/l - 1| of the springs of a fiber whose sections stand so, taken where the fiber is bent most; of a chain
/// that of the surface of a tube of its radius.
/// @param poses  [fiber.config.sections]
double measure_start_strain(const Fiber& fiber, const std::vector<SectionPose>& poses);

/// True where distant sections of a fiber (see Fiber::distant_sections) are nearer at the start than two radii.
/// @param poses  of make_section_poses, which go on and on along the fiber's direction
bool touches_itself(const Fiber& fiber, const std::vector<SectionPose>& poses);

/// How far the nodes of a fiber on a line are from those of a straight one of its length that fits them best, at most.
/// Length
/// @param fiber     of one node a section
/// @param position  [fiber.n_nodes()], length: this fiber's nodes only
double measure_bend(const Fiber& fiber, std::span<const Vec3> position);

/// Starts that cannot be: bends of more half waves than the sections resolve, or so strong that springs are strained by
/// more than largest_sound_strain, that the fiber touches itself or that its length does not suffice. Says what is
/// possible. A SceneCheck; copies of fibers are counted, wherever placement puts them.
std::vector<KeyProblem> find_start_problems(const SceneConfig& scene);

}  // namespace skein
