#include "cli/child_process.hpp"

#include <skein/core/error.hpp>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace skein {

int run_program(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  // What this program ignores, others know how to meet.
  posix_spawnattr_t attributes;
  sigset_t as_usual;
  sigemptyset(&as_usual);
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&as_usual, signal);
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &as_usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int failure = posix_spawn(&process, program.c_str(), nullptr, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) {
    throw Error(ExitCode::internal, fmt::format("{} cannot be started: {}", program, std::strerror(failure)));
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) throw Error(ExitCode::internal, fmt::format("waiting failed: {}", std::strerror(errno)));
  }
  if (WIFSIGNALED(status)) {
    throw Error(ExitCode::internal, fmt::format("{} was killed by signal {}", program, WTERMSIG(status)));
  }
  return WEXITSTATUS(status);
}

}  // namespace skein
