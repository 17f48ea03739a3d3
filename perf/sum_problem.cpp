#include "sum_problem.hpp"

#include <cmath>
#include <random>

namespace skein::perf {

SumProblem::SumProblem(const std::vector<Vec3>& nodes, const double blob_size)
    : n(static_cast<int>(nodes.size())),
      position(to_device("position", nodes)),
      force("force", nodes.size()),
      velocity("velocity", nodes.size()),
      blob(to_device("blob", std::vector<double>(nodes.size(), blob_size))) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vec3> forces(nodes.size());
  for (Vec3& f : forces) f = {uniform(random), uniform(random), uniform(random)};
  force = to_device("force", forces);
}

void SumProblem::move_nodes() {
  const Vectors x = position;
  Kokkos::parallel_for(
      "bench::move_nodes", Kokkos::RangePolicy<ExecSpace>(0, n), KOKKOS_LAMBDA(const int i) {
        for (int c = 0; c < 3; ++c) x(i, c) += 1e-7 * ((i * (c + 2)) % 7 - 3);
      });
}

void SumProblem::compute(Mobility& mobility) {
  Kokkos::deep_copy(velocity, 0.0);
  mobility.add_velocity(sources(), position, velocity);
}

double relative_error(const std::vector<Vec3>& got, const std::vector<Vec3>& exact) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    difference += dot(got[i] - exact[i], got[i] - exact[i]);
    size += dot(exact[i], exact[i]);
  }
  return std::sqrt(difference / size);
}

}  // namespace skein::perf
