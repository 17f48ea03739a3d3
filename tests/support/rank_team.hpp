#pragma once

namespace skein {

class SumTeam;

namespace test {

/// The ranks that share the sums of a test's mobilities; null in a program that is one process by design.
SumTeam* find_team();

}  // namespace test
}  // namespace skein
