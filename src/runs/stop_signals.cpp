#include "runs/stop_signals.hpp"

#include <atomic>
#include <iterator>

namespace skein {
namespace {

// All that a handler may touch.
std::atomic<int> n_received{0}, last_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

struct Signal {
  int number;
  const char* name;
};

constexpr Signal stopping[] = {{SIGINT, "SIGINT"},   {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"},  {SIGXCPU, "SIGXCPU"},
                               {SIGUSR1, "SIGUSR1"}, {SIGUSR2, "SIGUSR2"}, {SIGALRM, "SIGALRM"}};

void count_signal(const int signal) {
  last_signal.store(signal);
  n_received.fetch_add(1);
}

void install(const int signal, struct sigaction& old_action) {
  struct sigaction action {};
  action.sa_handler = count_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, &old_action);
  if (signal == SIGHUP && old_action.sa_handler == SIG_IGN) sigaction(signal, &old_action, nullptr);
}

}  // namespace

StopSignals::StopSignals() {
  static_assert(std::size(stopping) == n_signals);
  n_received = 0;
  struct sigaction* old_action = old_actions_;
  for (const Signal& signal : stopping) install(signal.number, *old_action++);
}

StopSignals::~StopSignals() {
  const struct sigaction* old_action = old_actions_;
  for (const Signal& signal : stopping) sigaction(signal.number, old_action++, nullptr);
}

void StopSignals::let_them_end_this_process() {
  for (const Signal& signal : stopping) {
    struct sigaction action {};
    if (sigaction(signal.number, nullptr, &action) == 0 && action.sa_handler == count_signal)
      std::signal(signal.number, SIG_DFL);
  }
}

int StopSignals::count() const { return n_received.load(); }

int StopSignals::number() const { return last_signal.load(); }

const char* StopSignals::name() const {
  for (const Signal& signal : stopping)
    if (signal.number == number()) return signal.name;
  return "no signal";
}

}  // namespace skein
