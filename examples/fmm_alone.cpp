// The fast multipole method alone, for any points and forces: velocities at 20 000 points to four digits, and what the
// plan expected of them.

#include <skein/arrays/runtime.hpp>
#include <skein/fmm/fmm_sum.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace {

constexpr double viscosity = 1.3, blob = 1e-3;

/// Regularized Stokeslets summed by hand at one point.
skein::Vec3 sum_directly(const std::vector<skein::Vec3>& position, const std::vector<skein::Vec3>& force,
                         const skein::Vec3 at) {
  skein::Vec3 sum;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const skein::Vec3 d = at - position[i];
    const double square = skein::dot(d, d) + blob * blob;
    sum = sum + ((square + blob * blob) * force[i] + skein::dot(d, force[i]) * d) / (square * std::sqrt(square));
  }
  return sum / (8.0 * std::numbers::pi * viscosity);
}

}  // namespace

int main() {
  const skein::Runtime runtime;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto draw = [&] { return skein::Vec3{uniform(random), uniform(random), uniform(random)}; };
  std::vector<skein::Vec3> position(20000), force(position.size());
  for (auto& x : position) x = draw();
  for (auto& f : force) f = draw();

  skein::FmmOptions options;
  options.tolerance = 1e-4;
  const auto sum = skein::make_fmm_sum(skein::KernelPath::automatic);
  const skein::Vectors x = skein::to_device("position", position), velocity("velocity", position.size());
  const skein::Sources sources{x, skein::to_device("force", force),
                               skein::to_device("blob", std::vector<double>(position.size(), blob))};
  sum->take(sources, x);
  sum->compute(options, skein::choose_fmm_plan(options, sum->largest_blob(), 0), viscosity);
  sum->add_to(velocity);

  const auto found = skein::to_host(skein::ConstVectors(velocity));
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < found.size(); i += 199) {
    const skein::Vec3 exact = sum_directly(position, force, position[i]), d = found[i] - exact;
    difference += skein::dot(d, d);
    size += skein::dot(exact, exact);
  }
  const double error = std::sqrt(difference / size);
  std::printf("%zu points, order %d: error %.2g (2-norm), %.1g allowed\n", position.size(), sum->statistics.plan.order,
              error, options.tolerance);
  return error < options.tolerance ? 0 : 1;
}
