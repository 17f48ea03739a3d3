#include "studies/side_by_side.hpp"

#include <skein/arrays/default_path.hpp>
#include <skein/arrays/runtime.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/scene/scene_size.hpp>

#include "runs/memory_limit.hpp"
#include "runs/process_pool.hpp"
#include "runs/run_control.hpp"
#include "runs/run_to_end.hpp"
#include "runs/stop_signals.hpp"
#include "runs/useful_threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <numeric>
#include <thread>

namespace skein {
namespace {

constexpr int most_attempts = 3;
constexpr double look_interval = 0.2;  // seconds

/// A run that another process still writes, as one whose sweep was killed does until its checkpoint is there, is waited
/// for.
ExitCode run_when_free(const NewRun& run, const std::filesystem::path& folder, const double max_walltime) {
  using namespace std::chrono_literals;
  RunListener silent;
  for (int attempt = 0;; ++attempt) {
    try {
      return run_to_end(run.placed.config, folder, max_walltime, silent, run.start);
    } catch (const Error& error) {
      constexpr int patience = 40;
      const bool may_become_free = attempt == 0 || (attempt < patience && is_there(folder / "lock"));
      if (error.code() != ExitCode::cannot_create || !may_become_free) throw;
    }
    std::this_thread::sleep_for(250ms);
  }
}

/// All that the process of one run does.
int run_and_measure(const RunList& list, const std::size_t i, const double max_walltime) {
  const ExitCode code = run_when_free(list.make(i), list.run(i), max_walltime);
  if (code == ExitCode::done) write_run_result(list.result(i), {code, "", measure_run(RunFolder::open(list.run(i)))});
  return static_cast<int>(code);
}

int choose_jobs(const RunList& list, const std::size_t n_open, const SideBySide& how, const int n_threads) {
  // Runs of a thread each are faster than as many one after another with all threads, whatever their size. A device is
  // shared by few: it has one memory, and processes take turns.
  constexpr int jobs_on_device = 4;
  int n = how.n_jobs > 0                         ? how.n_jobs
          : default_path() == KernelPath::device ? std::min(jobs_on_device, n_threads)
                                                 : n_threads;
  if (list.largest_memory > 0)
    n = std::min(n, static_cast<int>(std::min(find_memory_limit() / static_cast<double>(list.largest_memory), 1e4)));
  return std::clamp(n, 1, std::max(1, static_cast<int>(n_open)));
}

/// What the process of a run has left.
RunResult judge(const RunList& list, const WorkEnd& end) {
  if (end.signal != 0)
    return {ExitCode::internal,
            fmt::format("its process was ended {} times by {}; is there enough memory?", most_attempts,
                        name_of_signal(end.signal)),
            {}};
  const auto code = static_cast<ExitCode>(end.exit_code);
  if (code != ExitCode::done) return {code, end.message, {}};
  const auto result = read_run_result(list.result(end.item));
  if (!result)
    throw Error(ExitCode::io_error,
                fmt::format("'{}' was written and cannot be read.", list.result(end.item).string()));
  return *result;
}

class Crew {
 public:
  Crew(const RunList& list, const std::vector<std::size_t>& open, const SideBySide& how, SideBySideListener& listener)
      : list_(list),
        how_(how),
        listener_(listener),
        waiting_(open),
        results_(list.names.size()),
        attempts_(list.names.size(), 0) {
    // Taken from the back: the dearest first, and of alike ones the first.
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [&](const std::size_t a, const std::size_t b) { return list.costs[a] > list.costs[b]; });
    std::reverse(waiting_.begin(), waiting_.end());
    n_threads_ = count_host_threads(how.n_threads);
    n_jobs_ = choose_jobs(list, open.size(), how, n_threads_);
  }

  std::vector<std::optional<RunResult>> work() {
    listener_.begin(waiting_.size(), n_jobs_, n_threads_);
    while (pool_.n_running() > 0 || (!waiting_.empty() && !is_stopping_)) {
      look_for_requests();
      while (!is_stopping_ && !waiting_.empty() && pool_.n_running() < static_cast<std::size_t>(n_jobs_)) start_next();
      if (const auto end = pool_.wait(look_interval)) take(*end);
      listener_.look(pool_.n_running());
    }
    if (failure_) throw *failure_;
    return std::move(results_);
  }

 private:
  void start_next() {
    const std::size_t item = waiting_.back();
    waiting_.pop_back();
    // What is free, shared by those that come next: the last runs get more threads, as far as they make them faster.
    const int free_places = n_jobs_ - static_cast<int>(pool_.n_running());
    const int n_next = std::min(free_places, static_cast<int>(waiting_.size()) + 1);
    const int n_free = std::max(n_next, n_threads_ - pool_.n_threads());
    ++attempts_[item];
    pool_.start(item, std::min((n_free + n_next - 1) / n_next, list_.useful_threads[item]),
                [this, item] { return run_and_measure(list_, item, how_.max_walltime); });
  }

  void take(const WorkEnd& end) {
    const auto code = static_cast<ExitCode>(end.exit_code);
    if (end.signal != 0 && !is_stopping_ && attempts_[end.item] < most_attempts) {
      waiting_.push_back(end.item);
      return;
    }
    if (code == ExitCode::stopped || (end.signal != 0 && is_stopping_)) {
      stop();
      return;
    }
    if ((code == ExitCode::io_error || code == ExitCode::usage) && !failure_) {
      failure_.emplace(code, end.message);
      stop();
      return;
    }
    const RunResult result = judge(list_, end);
    if (end.signal == 0 && fails_always(result.code)) write_run_result(list_.result(end.item), result);
    results_[end.item] = result;
    listener_.end_of_run(end.item, result, end.seconds);
  }

  void stop() {
    if (!is_stopping_) pool_.signal_all(SIGTERM);
    is_stopping_ = true;
  }

  /// A run finds the end of its wall time itself; between runs it is found here.
  void look_for_requests() {
    const bool is_late = RunControl::seconds_since_program_start() >= how_.max_walltime;
    if (signals_.count() > n_signals_passed_ || is_late || (!how_.stop_file.empty() && is_there(how_.stop_file))) {
      if (is_stopping_ && signals_.count() > n_signals_passed_) pool_.signal_all(SIGTERM);
      n_signals_passed_ = signals_.count();
      stop();
    }
  }

  const RunList& list_;
  const SideBySide& how_;
  SideBySideListener& listener_;
  StopSignals signals_;
  int n_signals_passed_ = 0;
  bool is_stopping_ = false;
  std::vector<std::size_t> waiting_;
  std::vector<std::optional<RunResult>> results_;
  std::vector<int> attempts_;
  std::optional<Error> failure_;
  int n_threads_, n_jobs_;
  ProcessPool pool_;
};

}  // namespace

void add_estimates(RunList& list, const SceneConfig& scene) {
  const double n_nodes = count_scene_nodes(scene);
  list.costs.push_back(n_nodes * n_nodes * (scene.time.end - scene.time.start));
  list.useful_threads.push_back(count_useful_threads(scene));
  list.largest_memory = std::max(list.largest_memory, static_cast<std::size_t>(estimate_memory(scene)));
}

std::vector<std::optional<RunResult>> run_side_by_side(const RunList& list, const std::vector<std::size_t>& open,
                                                       const SideBySide& how, SideBySideListener& listener) {
  return Crew(list, open, how, listener).work();
}

}  // namespace skein
