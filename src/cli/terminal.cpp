#include "cli/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace skein {
namespace {

void print(const std::string_view color, const std::string_view heading, const std::string& message) {
  const bool colored = stderr_has_color();
  const std::string text =
      fmt::format("{}skein:{} {}{}\n", colored ? color : "", colored ? "\033[0m" : "", heading, message);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace

bool stderr_is_terminal() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

int count_terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

bool stderr_has_color() {
  const char* forbidden = std::getenv("NO_COLOR");
  return stderr_is_terminal() && (forbidden == nullptr || *forbidden == '\0');
}

void print_error(const std::string& message) { print("\033[1;31m", "", message); }
void print_warning(const std::string& message) { print("\033[1;33m", "warning: ", message); }

}  // namespace skein
