#include "mpi/launch.hpp"
#include "mpi/rank_watch.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace skein {
namespace {

/// Looks four times a second, hearing of the ranks that `hears` names. @returns the first verdict and its time
std::pair<int, double> watch(PulseBook& book, const double from, const double to, const std::vector<int>& hears) {
  for (double now = from; now <= to; now += 0.25) {
    for (const int rank : hears) book.hear(rank, now);
    if (const int silent = book.look(now); silent >= 0) return {silent, now};
  }
  return {-1, to};
}

TEST(PulseBook, NamesTheRankThatIsSilentWithinSixSeconds) {
  PulseBook book({1, 2, 3}, 100.0);
  EXPECT_EQ(watch(book, 100.0, 200.0, {1, 2, 3}).first, -1);
  const auto [rank, at] = watch(book, 200.25, 300.0, {1, 3});
  EXPECT_EQ(rank, 2);
  EXPECT_GT(at, 204.9);
  EXPECT_LT(at, 206.0);
}

TEST(PulseBook, NamesARankThatWasNeverHeardOf) {
  PulseBook book({0}, 0.0);
  EXPECT_EQ(watch(book, 0.0, 10.0, {}).first, 0);
}

TEST(PulseBook, ForgivesEveryoneAfterItWasStoppedItself) {
  PulseBook book({1}, 0.0);
  EXPECT_EQ(watch(book, 0.0, 3.0, {1}).first, -1);
  EXPECT_EQ(watch(book, 3600.0, 3604.0, {}).first, -1);  // an hour without a look
  EXPECT_EQ(watch(book, 3604.0, 3610.0, {}).first, 1);
}

TEST(PulseBook, DoesNotMindStrangers) {
  PulseBook book({1}, 0.0);
  book.hear(7, 1.0);
  EXPECT_EQ(book.look(1.0), -1);
}

/// What a process says of itself that works from `since` on with so much of a processor.
std::string work(WorkWatch& watch, const double since, const double to, const double share, const double longest) {
  for (double now = since; now <= to; now += 0.25)
    if (std::string fault = watch.look(now, since, longest, 50.0 + share * now); !fault.empty()) return fault;
  return {};
}

TEST(WorkWatch, LetsItWorkForAnHour) {
  WorkWatch watch;
  EXPECT_EQ(work(watch, 10.0, 3610.0, 1.0, 0.0), "");
}

TEST(WorkWatch, LetsABusyMachineTakeItsTime) {
  WorkWatch watch;
  EXPECT_EQ(work(watch, 10.0, 60.0, 0.02, 10.0), "");
}

TEST(WorkWatch, FindsAProcessThatSleeps) {
  WorkWatch watch;
  EXPECT_EQ(work(watch, 10.0, 14.5, 0.0, 0.0), "");
  EXPECT_NE(work(watch, 10.0, 17.0, 0.0, 0.0).find("does nothing"), std::string::npos);
}

TEST(WorkWatch, FindsWorkThatIsFarLongerThanAnyBefore) {
  WorkWatch watch;
  EXPECT_EQ(work(watch, 10.0, 15.5, 1.0, 0.1), "");
  EXPECT_NE(work(watch, 10.0, 17.5, 1.0, 0.1).find("comes to no end"), std::string::npos);
  WorkWatch of_long_sums;
  EXPECT_EQ(work(of_long_sums, 10.0, 60.0, 1.0, 3.0), "");
}

TEST(WorkWatch, DoesNotMindWaiting) {
  WorkWatch watch;
  for (double now = 0.0; now < 100.0; now += 0.25) EXPECT_EQ(watch.look(now, -1.0, 0.01, 1.0), "");
}

TEST(WorkWatch, ForgivesItselfAfterItWasStopped) {
  WorkWatch watch;
  EXPECT_EQ(work(watch, 10.0, 12.0, 1.0, 0.1), "");
  EXPECT_EQ(watch.look(500.0, 10.0, 0.1, 62.0), "");
}

class LaunchTest : public ::testing::Test {
 protected:
  static constexpr const char* variables[] = {
      "OMPI_COMM_WORLD_SIZE",       "OMPI_COMM_WORLD_RANK", "PMI_SIZE",     "PMI_RANK",     "PMIX_RANK",
      "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS",      "SLURM_NTASKS", "SLURM_PROCID", "OMP_NUM_THREADS",
      "KOKKOS_NUM_THREADS"};
  void SetUp() override {
    for (const char* variable : variables) {
      const char* value = std::getenv(variable);
      before_.push_back(value == nullptr ? std::string() : value);
      unsetenv(variable);
    }
  }
  void TearDown() override {
    for (std::size_t i = 0; i < before_.size(); ++i)
      before_[i].empty() ? unsetenv(variables[i]) : setenv(variables[i], before_[i].c_str(), 1);
  }

 private:
  std::vector<std::string> before_;
};

TEST_F(LaunchTest, AProgramByItselfHasNoLauncher) { EXPECT_EQ(find_launch().size, 0); }

TEST_F(LaunchTest, AScriptOfSlurmStartsNoRanks) {
  setenv("SLURM_NTASKS", "8", 1);
  setenv("SLURM_PROCID", "0", 1);
  EXPECT_EQ(find_launch().size, 0);
}

TEST_F(LaunchTest, KnowsOpenMpi) {
  setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  setenv("OMPI_COMM_WORLD_RANK", "3", 1);
  setenv("OMPI_COMM_WORLD_LOCAL_SIZE", "2", 1);
  const Launch launch = find_launch();
  EXPECT_EQ(launch.size, 4);
  EXPECT_EQ(launch.rank, 3);
  EXPECT_EQ(launch.n_on_machine, 2);
}

TEST_F(LaunchTest, KnowsPmiAndPmix) {
  setenv("PMI_SIZE", "6", 1);
  setenv("PMI_RANK", "5", 1);
  EXPECT_EQ(find_launch().size, 6);
  EXPECT_EQ(find_launch().rank, 5);
  unsetenv("PMI_SIZE");
  unsetenv("PMI_RANK");
  setenv("PMIX_RANK", "2", 1);
  EXPECT_GE(find_launch().size, 1);
  EXPECT_EQ(find_launch().rank, 2);
}

TEST_F(LaunchTest, WhatIsNoNumberIsNoLauncher) {
  setenv("OMPI_COMM_WORLD_SIZE", "many", 1);
  EXPECT_EQ(find_launch().size, 0);
}

TEST_F(LaunchTest, RanksShareTheProcessorsUnlessTheNumberOfThreadsIsSaid) {
  EXPECT_EQ(share_threads(0), 0);
  setenv("OMPI_COMM_WORLD_SIZE", "1000", 1);
  setenv("OMPI_COMM_WORLD_LOCAL_SIZE", "1000", 1);
  EXPECT_EQ(share_threads(0), 1);
  EXPECT_EQ(share_threads(3), 3);
  setenv("OMP_NUM_THREADS", "5", 1);
  EXPECT_EQ(share_threads(0), 0);
}

}  // namespace
}  // namespace skein
