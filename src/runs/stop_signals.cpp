#include "runs/stop_signals.hpp"

#include <atomic>

namespace skein {
namespace {

// All that a handler may touch.
std::atomic<int> n_received{0}, last_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int stopping[] = {SIGINT, SIGTERM, SIGUSR1};
constexpr int ignored[] = {SIGPIPE, SIGXFSZ};

void count_signal(const int signal) {
  last_signal.store(signal);
  n_received.fetch_add(1);
}

void install(const int signal, void (*handler)(int), struct sigaction& old_action) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, &old_action);
}

}  // namespace

StopSignals::StopSignals() {
  n_received = 0;
  struct sigaction* old_action = old_actions_;
  for (const int signal : stopping) install(signal, count_signal, *old_action++);
  for (const int signal : ignored) install(signal, SIG_IGN, *old_action++);
}

StopSignals::~StopSignals() {
  const struct sigaction* old_action = old_actions_;
  for (const int signal : stopping) sigaction(signal, old_action++, nullptr);
  for (const int signal : ignored) sigaction(signal, old_action++, nullptr);
}

int StopSignals::count() const { return n_received.load(); }

const char* StopSignals::name() const {
  switch (last_signal.load()) {
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    default:
      return "SIGUSR1";
  }
}

}  // namespace skein
