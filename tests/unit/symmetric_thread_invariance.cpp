// Prints a hash of the bits of sums over images, for compare_thread_counts.cmake to compare between numbers of threads.
// The first line says how many threads there were.
#include <skein/arrays/runtime.hpp>

#include "tests/unit/symmetric_case.hpp"

#include <cstdio>
#include <functional>
#include <string_view>

namespace skein {
namespace {

void print_hashes() {
  std::printf("threads %d\n", HostSpace().concurrency());
  for (const SymmetricCase& scene : list_symmetric_cases()) {
    const SymmetricSources nodes(scene);
    for (const Precision precision : {Precision::in_double, Precision::in_single}) {
      SymmetricMobility mobility(1.7, precision, nodes.symmetry);
      const auto velocity = nodes.compute(mobility);
      const std::string_view bytes(reinterpret_cast<const char*>(velocity.data()), velocity.size() * sizeof(Vec3));
      std::printf("%s, %zu nodes, %s %zx\n", scene.name.c_str(), velocity.size(),
                  precision == Precision::in_double ? "double" : "single", std::hash<std::string_view>()(bytes));
    }
  }
}

}  // namespace
}  // namespace skein

int main() {
  const skein::Runtime runtime;
  skein::print_hashes();
}
