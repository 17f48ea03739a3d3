#pragma once

#include <vector>

namespace skein::reference {

/// Appends the nodes and weights of the rule of Gauss and Legendre on [-1, 1], exact for polynomials of degree 2 n - 1.
void make_gauss_rule(int n, std::vector<double>& node, std::vector<double>& weight);

}  // namespace skein::reference
