// Asking a run to stop: what is seen, and when a step may not be finished any more.

#include <skein/io/atomic_file.hpp>

#include "runs/run_control.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <limits>
#include <thread>

namespace skein {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
using Demand = RunControl::Demand;

void wait_for_next_look() { std::this_thread::sleep_for(std::chrono::milliseconds(250)); }

TEST(RunControl, WantsNothingByItself) {
  RunControl control(no_limit);
  EXPECT_EQ(control.look(1e9), Demand::none);
  EXPECT_NO_THROW(control.check_within_step());
}

TEST(RunControl, TheFirstSignalLetsTheStepFinishTheSecondDoesNot) {
  for (const auto& [signal, name] :
       {std::pair(SIGINT, "SIGINT"), std::pair(SIGTERM, "SIGTERM"), std::pair(SIGUSR1, "SIGUSR1"),
        std::pair(SIGUSR2, "SIGUSR2"), std::pair(SIGHUP, "SIGHUP"), std::pair(SIGXCPU, "SIGXCPU"),
        std::pair(SIGALRM, "SIGALRM")}) {
    RunControl control(no_limit);
    std::raise(signal);
    EXPECT_NO_THROW(control.check_within_step());
    EXPECT_EQ(control.look(0.0), Demand::stop);
    EXPECT_NE(control.reason().find(name), std::string::npos);
    std::raise(signal);
    EXPECT_THROW(control.check_within_step(), Interruption);
  }
  RunControl next(no_limit);
  EXPECT_EQ(next.look(0.0), Demand::none);
}

TEST(RunControl, AHangupThatWasIgnoredStaysSo) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  {
    RunControl control(no_limit);
    std::raise(SIGHUP);
    EXPECT_EQ(control.look(0.0), Demand::none);
    std::raise(SIGTERM);
    EXPECT_EQ(control.look(0.0), Demand::stop);
  }
  EXPECT_EQ(std::signal(SIGHUP, before), SIG_IGN);
}

TEST(RunControl, ALongStepIsGivenUpAfterSomePatience) {
  RunControl control(no_limit);
  std::raise(SIGTERM);
  const auto asked = std::chrono::steady_clock::now();
  EXPECT_THROW(
      for (;;) {
        control.check_within_step();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      },
      Interruption);
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - asked;
  EXPECT_GE(waited.count(), RunControl::patience - 0.1);
  EXPECT_LT(waited.count(), 10.0);
}

TEST(RunControl, ALauncherMayLeaveLessPatience) {
  RunControl control(no_limit);
  control.set_patience(0.1);
  std::raise(SIGTERM);
  EXPECT_NO_THROW(control.check_within_step());
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  EXPECT_THROW(control.check_within_step(), Interruption);
}

TEST(RunControl, FilesAreSeenWithinAFifthOfASecond) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "", false);
  write_file_atomically(folder.stop_request(), "");
  RunControl control(no_limit);
  control.watch(folder);  // an old request is no request
  EXPECT_FALSE(std::filesystem::exists(folder.stop_request()));
  EXPECT_EQ(control.look(0.0), Demand::none);

  write_file_atomically(folder.output_request(), "");
  EXPECT_EQ(control.look(0.0), Demand::none);  // too early to look again
  wait_for_next_look();
  EXPECT_EQ(control.look(0.0), Demand::checkpoint);
  EXPECT_FALSE(std::filesystem::exists(folder.output_request()));
  EXPECT_EQ(control.look(0.0), Demand::none);

  write_file_atomically(folder.stop_request(), "");
  wait_for_next_look();
  EXPECT_EQ(control.look(0.0), Demand::stop);
  EXPECT_NE(control.reason().find("STOP"), std::string::npos);
}

// The wall time counts from the start of the program: what is left of it has to hold a step and two checkpoints.
TEST(RunControl, WallTimeLeavesRoomForACheckpoint) {
  RunControl control(RunControl::seconds_since_program_start() + 100.0);
  EXPECT_EQ(control.look(90.0), Demand::none);
  EXPECT_NO_THROW(control.check_within_step());
  control.note_checkpoint(10.0);
  EXPECT_EQ(control.look(75.0), Demand::none);
  EXPECT_EQ(control.look(90.0), Demand::stop);
  EXPECT_NE(control.reason().find("wall time"), std::string::npos);

  RunControl late(RunControl::seconds_since_program_start() + 10.0);
  late.note_checkpoint(6.0);
  EXPECT_THROW(late.check_within_step(), Interruption);
}

}  // namespace
}  // namespace skein
