#include "runs/rank_faults.hpp"

#include <skein/core/error.hpp>

#include "runs/test_order.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <string>
#include <thread>

namespace skein {
namespace {

void suffer(const std::string& fault, const Vectors& force) {
  std::ofstream("rank_fault") << fault << '\n';
  if (fault == "throw") throw Error(ExitCode::internal, "SKEIN_TEST_RANK asks for this error");
  if (fault == "nan") return Kokkos::deep_copy(force, std::nan(""));
  while (fault == "sleep") std::this_thread::sleep_for(std::chrono::hours(1));
  volatile double number = 0.0;
  while (fault == "spin") number = number + 1.0;
}

}  // namespace

std::function<void(const Vectors& force)> read_rank_fault() {
  const TestOrder order = read_test_order("SKEIN_TEST_RANK");
  if (order.number <= 0) return {};
  return [order = TestOrder(order)](const Vectors& force) mutable {
    if (--order.number <= 0) suffer(order.name, force);
  };
}

}  // namespace skein
