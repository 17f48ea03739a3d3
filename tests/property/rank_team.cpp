#include "tests/support/rank_team.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/physics/sum_team.hpp>

#include "mpi/launch.hpp"

#include <gtest/gtest.h>

#include <memory>

// Tests of sums that ranks share: rank 0 runs them, the others serve.

namespace skein::test {
namespace {

std::unique_ptr<SumTeam> team;

}  // namespace

SumTeam* find_team() { return team.get(); }

int run_tests(Communicator& ranks) {
  const Runtime runtime;
  if (ranks.rank() > 0) return serve_sums(ranks);
  team = std::make_unique<SumTeam>(ranks);
  const int code = RUN_ALL_TESTS();
  team.reset();
  dismiss_ranks(ranks, code);
  return code;
}

}  // namespace skein::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  skein::Communicator* const ranks = skein::join_ranks();
  if (ranks == nullptr) return 64;
  return skein::leave_ranks(skein::test::run_tests(*ranks));
}
