#include <skein/core/orbit_class.hpp>

#include <algorithm>

namespace skein {

std::vector<SignMatrix> list_distinct_images(const std::vector<SignMatrix>& group, const OrbitClass& a,
                                             const OrbitClass& b) {
  std::vector<SignMatrix> distinct;
  for (const SignMatrix element : group) {
    const bool is_new = std::none_of(distinct.begin(), distinct.end(), [&](const SignMatrix known) {
      for (const SignMatrix of_a : a.stabilizer)
        for (const SignMatrix of_b : b.stabilizer)
          if (known * of_a * of_b == element) return true;
      return false;
    });
    if (is_new) distinct.push_back(element);
  }
  return distinct;
}

double count_image_pairs(const std::vector<SignMatrix>& group, const std::vector<OrbitClass>& classes) {
  double n_pairs = 0.0;
  for (const OrbitClass& a : classes)
    for (const OrbitClass& b : classes)
      n_pairs += static_cast<double>(a.count) * b.count * static_cast<double>(list_distinct_images(group, a, b).size());
  return n_pairs;
}

}  // namespace skein
