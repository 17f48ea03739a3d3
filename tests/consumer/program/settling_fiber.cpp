// A straight fiber that falls under equal forces on its nodes: faster along itself than across.

#include <skein/arrays/runtime.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/direct_mobility.hpp>

#include <cstdio>

namespace {

double mean_speed(const skein::Vec3 force) {
  const auto fibers = skein::make_fibers({skein::FiberConfig{}});
  const auto nodes = skein::make_surface_nodes(fibers);
  const auto position = skein::to_device("position", nodes);
  const skein::Vectors velocity("velocity", nodes.size());
  skein::DirectMobility mobility(1.3, skein::Precision::in_double);
  mobility.add_velocity({position, skein::to_device("force", std::vector<skein::Vec3>(nodes.size(), force)),
                         skein::to_device("blob", skein::make_blobs(fibers))},
                        position, velocity);
  double speed = 0.0;
  for (const skein::Vec3& u : skein::to_host(velocity)) speed += skein::dot(u, force) / nodes.size();
  return speed;
}

}  // namespace

int main() {
  const skein::Runtime runtime;
  const double along = mean_speed({1.0, 0.0, 0.0}), across = mean_speed({0.0, 1.0, 0.0});
  std::printf("along %.4g, across %.4g, ratio %.4f\n", along, across, along / across);
  return along > 1.2 * across && along < 2.0 * across ? 0 : 1;
}
