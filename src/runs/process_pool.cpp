#include "runs/process_pool.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/core/resource_error.hpp>

#include "runs/run_control.hpp"
#include "runs/stop_signals.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

namespace skein {
namespace {

constexpr std::size_t longest_message = 8000;

/// Signals wait while it lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_SETMASK, &all, &before_);
  }
  ~HeldSignals() { let_come(); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  void let_come() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

/// Without the signal handlers and files of the process that this one is a copy of.
void leave_parent(const pid_t parent, const int pipe) {
  StopSignals::let_them_end_this_process();
  ::setpgid(0, 0);  // signals of the terminal are for the parent, which passes them on
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) std::raise(SIGTERM);
  // The locks that the parent holds by open files would outlive it.
  if (pipe > STDERR_FILENO + 1) ::close_range(STDERR_FILENO + 1, static_cast<unsigned>(pipe - 1), 0);
  ::close_range(static_cast<unsigned>(pipe + 1), ~0u, 0);
}

int do_work(const ProcessPool::Work& work, const int n_threads, std::string& message) {
  try {
    const Runtime runtime(n_threads);
    return work();
  } catch (const Error& error) {
    message = error.what();
    return static_cast<int>(error.code());
  } catch (const std::system_error& error) {
    message = error.what();
    return static_cast<int>(ExitCode::io_error);
  } catch (const std::bad_alloc&) {
    message = "there is not enough memory; use fewer nodes, or let fewer runs go side by side";
    return static_cast<int>(ResourceError::exit_code);
  } catch (const std::exception& error) {
    message = error.what();
    return static_cast<int>(ExitCode::internal);
  }
}

void write_all(const int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) return;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void be_child(const pid_t parent, const HeldSignals& signals, const int pipe, const int n_threads,
                           const ProcessPool::Work& work) {
  leave_parent(parent, pipe);
  signals.let_come();
  std::string message;
  const int code = do_work(work, n_threads, message);
  write_all(pipe, message.substr(0, longest_message));
  ::_exit(code);  // nothing of the parent's is unwound here
}

}  // namespace

ProcessPool::~ProcessPool() {
  signal_all(SIGKILL);
  while (!running_.empty()) take(running_.size() - 1);
}

void ProcessPool::start(const std::size_t item, const int n_threads, const Work& work) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0)
    throw ResourceError(fmt::format("no pipe to another process can be made: {}.", std::strerror(errno)));
  const HeldSignals signals;
  const pid_t parent = ::getpid(), id = ::fork();
  if (id == 0) be_child(parent, signals, ends[1], n_threads, work);
  const int error = errno;
  ::close(ends[1]);
  if (id < 0) {
    ::close(ends[0]);
    throw ResourceError(fmt::format("no process can be started: {}.", std::strerror(error)));
  }
  running_.push_back({item, id, ends[0], n_threads, "", RunControl::seconds_since_program_start()});
}

std::optional<WorkEnd> ProcessPool::wait(const double seconds) {
  std::vector<pollfd> polled;
  for (const Process& process : running_) polled.push_back({process.pipe, POLLIN, 0});
  if (::poll(polled.data(), polled.size(), static_cast<int>(1e3 * seconds)) <= 0) return std::nullopt;
  for (std::size_t i = 0; i < polled.size(); ++i) {
    if (polled[i].revents == 0) continue;
    std::array<char, 4096> bytes{};
    const ssize_t n = ::read(running_[i].pipe, bytes.data(), bytes.size());
    if (n > 0) running_[i].message.append(bytes.data(), static_cast<std::size_t>(n));
    if (n == 0) return take(i);
  }
  return std::nullopt;
}

WorkEnd ProcessPool::take(const std::size_t index) {
  Process process = running_[index];
  running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(index));
  ::close(process.pipe);
  int status = 0;
  while (::waitpid(process.id, &status, 0) < 0 && errno == EINTR) continue;
  const bool is_killed = WIFSIGNALED(status);
  return {process.item, is_killed ? 0 : WEXITSTATUS(status), is_killed ? WTERMSIG(status) : 0,
          std::move(process.message), RunControl::seconds_since_program_start() - process.began};
}

void ProcessPool::signal_all(const int signal) const {
  for (const Process& process : running_) ::kill(process.id, signal);
}

int ProcessPool::n_threads() const {
  int n = 0;
  for (const Process& process : running_) n += process.n_threads;
  return n;
}

std::string name_of_signal(const int signal) {
  const char* name = ::sigabbrev_np(signal);
  return name == nullptr ? fmt::format("signal {}", signal) : fmt::format("SIG{}", name);
}

}  // namespace skein
