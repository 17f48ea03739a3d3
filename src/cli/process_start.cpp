#include "cli/process_start.hpp"

#include <skein/core/error.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace skein {

void prepare_process() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest number that is free is taken: this one. Without it nothing could be said.
    if (::open("/dev/null", O_RDWR) != descriptor) ::_exit(static_cast<int>(ExitCode::io_error));
  }
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

}  // namespace skein
