#include <skein/core/sign_matrix.hpp>

#include <algorithm>

namespace skein {

unsigned find_vanishing(const std::vector<SignMatrix>& matrices) {
  unsigned vanishing = 0;
  for (const SignMatrix matrix : matrices) vanishing |= matrix.negated;
  return vanishing;
}

std::vector<SignMatrix> make_group(const std::vector<SignMatrix>& generators) {
  std::vector<SignMatrix> group(1);
  for (const SignMatrix generator : generators) {
    if (std::find(group.begin(), group.end(), generator) != group.end()) continue;
    const std::vector<SignMatrix> before = group;
    for (const SignMatrix element : before) group.push_back(element * generator);
  }
  return group;
}

}  // namespace skein
