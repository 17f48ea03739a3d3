#include "cli/terminal.hpp"

#include <skein/core/terminal_text.hpp>

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
  const std::string text = fmt::format("{}skein:{} {}{}\n", colored ? color : "", colored ? "\033[0m" : "", heading,
                                       make_terminal_text(message));
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
void print_note(const std::string& message) { print("", "note: ", message); }

void print_message(const std::string& text) {
  const std::string line = make_terminal_text(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void print_result(const std::string& text) { fmt::print("{}", make_terminal_text(text)); }

}  // namespace skein
