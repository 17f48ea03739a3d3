#include "runs/shared_run.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/resource_error.hpp>
#include <skein/physics/sum_team.hpp>
#include <skein/ranks/rank_error.hpp>

#include "runs/rank_faults.hpp"
#include "runs/stop_signals.hpp"

#include <fmt/format.h>

#include <chrono>
#include <new>
#include <thread>

namespace skein {
namespace {

constexpr std::chrono::seconds for_rank_1_to_speak(4);

int serve(Communicator& ranks, const int threads) {
  int code = 0;
  const StopSignals heard_by_rank_0;  // which are sent to all
  try {
    const Runtime runtime(threads);
    code = serve_sums(ranks, read_rank_fault());
  } catch (const RankError&) {
    if (ranks.rank() > 1) std::this_thread::sleep_for(for_rank_1_to_speak);  // and to end all
    throw;
  } catch (const Error& error) {
    ranks.fail(static_cast<int>(error.code()), error.what());
  }
  return code;
}

/// The others may be gone, or in another place: then leave_ranks ends them.
void dismiss_as_far_as_possible(Communicator& ranks, const ExitCode code) {
  try {
    dismiss_ranks(ranks, static_cast<int>(code));
  } catch (const RankError&) {
  }
}

}  // namespace

int share_run(Communicator* ranks, const int threads, const std::function<int(Communicator* ranks)>& lead) {
  if (ranks == nullptr) return lead(nullptr);
  if (ranks->rank() > 0) return serve(*ranks, threads);
  try {
    const int code = lead(ranks);
    dismiss_ranks(*ranks, code);
    return code;
  } catch (const RankError&) {
    throw;
  } catch (const Error& error) {
    dismiss_as_far_as_possible(*ranks, error.code());
    throw;
  } catch (const std::bad_alloc&) {
    dismiss_as_far_as_possible(*ranks, ResourceError::exit_code);
    throw;
  } catch (...) {
    dismiss_as_far_as_possible(*ranks, ExitCode::internal);
    throw;
  }
}

std::string describe_ranks(SumTeam& team) {
  const Communicator& ranks = team.ranks();
  const std::string partition = team.partition().empty() ? "no sum yet" : team.partition();
  return fmt::format(
      "ranks: {}, {}, each {}; they share sums and forces{}, and bits are the same for any number of them: {}; {}",
      ranks.size(), ranks.describe(), describe_backend(),
      team.advances_parts() ? ", each advances the nodes of its sections" : "", partition,
      describe_balance(team.work_seconds()));
}

}  // namespace skein
