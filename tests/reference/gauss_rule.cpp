#include "tests/reference/gauss_rule.hpp"

#include <cmath>
#include <numbers>

namespace skein::reference {

void make_gauss_rule(const int n, std::vector<double>& node, std::vector<double>& weight) {
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0.0;
    // Newton's method on the Legendre polynomial by its recurrence; five steps reach rounding for any n.
    for (int iteration = 0; iteration < 8; ++iteration) {
      double p = 1.0, q = 0.0;
      for (int j = 1; j <= n; ++j) {
        const double next = ((2 * j - 1) * x * p - (j - 1) * q) / j;
        q = p;
        p = next;
      }
      slope = n * (x * p - q) / (x * x - 1.0);
      x -= p / slope;
    }
    node.push_back(x);
    weight.push_back(2.0 / ((1.0 - x * x) * slope * slope));
  }
}

}  // namespace skein::reference
