#include "tests/support/rank_team.hpp"

namespace skein::test {

SumTeam* find_team() { return nullptr; }

}  // namespace skein::test
