#include <skein/core/terminal_text.hpp>
#include <skein/io/run_log.hpp>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace skein {

RunLog::RunLog(const std::filesystem::path& path) : file_(path), start_(std::chrono::steady_clock::now()) {
  write(fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr))));
}

void RunLog::write(const std::string_view text) {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    file_.write_line(fmt::format("{:10.2f} s  {}", elapsed, make_terminal_text(text.substr(begin, end - begin))));
    begin = end + 1;
    if (begin == text.size()) return;  // the text closed its last line itself
  }
}

}  // namespace skein
