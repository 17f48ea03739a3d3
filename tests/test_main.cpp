#include <skein/arrays/runtime.hpp>

#include "tests/support/nan_trap.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <string_view>

namespace {

void report_trap(const int signal) {
  constexpr std::string_view text =
      "The test above made a NaN or divided by zero, and does not say that it means to (tests/support/nan_trap.hpp).\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Around each test, not around the framework's own work.
class NanTrap final : public ::testing::EmptyTestEventListener {
 public:
  void OnTestStart(const ::testing::TestInfo&) override { skein::test::set_nan_trap(true); }
  void OnTestEnd(const ::testing::TestInfo&) override { skein::test::set_nan_trap(false); }
};

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const skein::Runtime runtime;
  if (skein::test::traps_nan()) {
    std::signal(SIGFPE, report_trap);
    ::testing::UnitTest::GetInstance()->listeners().Append(new NanTrap);  // the framework deletes it
  }
  return RUN_ALL_TESTS();
}
