#include "runs/test_order.hpp"

#include <skein/core/milestone.hpp>

#include <csignal>
#include <cstdlib>
#include <string_view>

namespace skein {

TestOrder read_test_order(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return {};
  const std::string order = text;
  const auto colon = order.rfind(':');
  if (colon == std::string::npos) return {order, 1};
  return {order.substr(0, colon), std::strtol(order.c_str() + colon + 1, nullptr, 10)};
}

void install_kill_order() {
  const TestOrder order = read_test_order("SKEIN_TEST_KILL");
  if (order.number <= 0) return;
  observe_milestones([order = TestOrder(order)](const std::string_view name) mutable {
    if (name == order.name && --order.number == 0) std::raise(SIGKILL);
  });
}

}  // namespace skein
