#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>
#include <skein/physics/node_symmetry.hpp>

#include "device_list.hpp"

#include <utility>

namespace skein {
namespace {

std::vector<unsigned> list_vanishing(const NodeOrbits& orbits) {
  std::vector<unsigned> vanishing;
  for (const OrbitClass& run : orbits.classes)
    vanishing.insert(vanishing.end(), static_cast<std::size_t>(run.count), find_vanishing(run.stabilizer));
  return vanishing;
}

}  // namespace

NodeSymmetry::NodeSymmetry(NodeOrbits orbits)
    : orbits_(std::move(orbits)),
      image_("skein::NodeSymmetry::image", static_cast<std::size_t>(orbits_.n_orbits()), orbits_.group.size()),
      vanishing_(copy_to_device("skein::NodeSymmetry::vanishing", list_vanishing(orbits_))) {
  SKEIN_REQUIRE(!orbits_.group.empty() && orbits_.group.size() <= SignGroup::most_elements,
                "a group of sign matrices has 1 to 8");
  for (const SignMatrix element : orbits_.group) group_.element[group_.n_elements++] = element;
  const auto image = Kokkos::create_mirror_view(image_);
  for (int orbit = 0; orbit < orbits_.n_orbits(); ++orbit)
    for (int element = 0; element < group_.n_elements; ++element)
      image(orbit, element) = orbits_.image_of(orbit, element);
  Kokkos::deep_copy(image_, image);
}

void NodeSymmetry::project(const Vectors& vectors) const {
  SKEIN_REQUIRE(vectors.extent_int(0) == orbits_.n_nodes, "vectors are those of the symmetric nodes");
  const SignGroup group = group_;
  const auto image = image_;
  const auto vanishing = vanishing_;
  launch<ExecSpace>(
      "skein::NodeSymmetry::project", ExecSpace(), Calls{image.extent_int(0), 10.0}, KOKKOS_LAMBDA(const int orbit) {
        const Vec3 v = without_components(vanishing(orbit), load(vectors, image(orbit, 0)));
        for (int element = 0; element < group.n_elements; ++element)
          if (image(orbit, element) >= 0) store(vectors, image(orbit, element), group.element[element] * v);
      });
}

void NodeSymmetry::take_first(const ConstVectors& of_node, const Vectors& of_orbit) const {
  SKEIN_REQUIRE(of_node.extent_int(0) == orbits_.n_nodes && of_orbit.extent_int(0) == orbits_.n_orbits(),
                "vectors are those of the symmetric nodes and of their orbits");
  const auto image = image_;
  const auto vanishing = vanishing_;
  launch<ExecSpace>(
      "skein::NodeSymmetry::take_first", ExecSpace(), Calls{image.extent_int(0), 10.0}, KOKKOS_LAMBDA(const int orbit) {
        store(of_orbit, orbit, without_components(vanishing(orbit), load(of_node, image(orbit, 0))));
      });
}

void NodeSymmetry::add_images(const ConstVectors& of_orbit, const Vectors& of_node) const {
  SKEIN_REQUIRE(of_node.extent_int(0) == orbits_.n_nodes && of_orbit.extent_int(0) == orbits_.n_orbits(),
                "vectors are those of the symmetric nodes and of their orbits");
  const SignGroup group = group_;
  const auto image = image_;
  const auto vanishing = vanishing_;
  launch<ExecSpace>(
      "skein::NodeSymmetry::add_images", ExecSpace(), Calls{image.extent_int(0), 10.0}, KOKKOS_LAMBDA(const int orbit) {
        const Vec3 v = without_components(vanishing(orbit), load(of_orbit, orbit));
        for (int element = 0; element < group.n_elements; ++element)
          if (const int node = image(orbit, element); node >= 0)
            store(of_node, node, load(of_node, node) + group.element[element] * v);
      });
}

}  // namespace skein
