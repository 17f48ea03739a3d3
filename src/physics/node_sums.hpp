#pragma once

#include <skein/arrays/launch.hpp>
#include <skein/arrays/types.hpp>
#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>

#include <numeric>
#include <string>
#include <vector>

namespace skein {

/// numbers[node] = value(node).
template <class Value>
struct SetNumbers {
  FoundReals numbers;
  Value value;
  KOKKOS_INLINE_FUNCTION void operator()(const int node) const { numbers(node) = value(node); }
};

/// A number of each node, summed over each fiber: nodes in order, whatever the number of threads. Holds scratch.
class NodeSums {
 public:
  NodeSums(const std::string& name, const std::vector<Fiber>& fibers, const std::size_t n_nodes)
      : of_node_(name, n_nodes) {
    for (const Fiber& fiber : fibers) n_nodes_.push_back(fiber.n_nodes());
  }

  /// Launches the search for value(node) of all nodes, which is there after the next wait for the device.
  template <class Value>
  void seek(const char* label, const Value& value) const {
    launch<ExecSpace>(label, ExecSpace(), Calls{of_node_.extent_int(0), 25.0}, SetNumbers<Value>{of_node_, value});
  }
  /// sum[fiber] += what was found for its nodes. @param sum  [n_fibers]
  void add_found(std::vector<double>& sum) const {
    SKEIN_REQUIRE(sum.size() == n_nodes_.size(), "one sum for each fiber");
    const double* node = of_node_.data();
    for (std::size_t f = 0; f < sum.size(); node += n_nodes_[f++])
      sum[f] += std::accumulate(node, node + n_nodes_[f], 0.0);
  }
  /// Both, with a wait between.
  template <class Value>
  void add(const char* label, std::vector<double>& sum, const Value& value) const {
    seek(label, value);
    wait_for(ExecSpace());
    add_found(sum);
  }

 private:
  FoundReals of_node_;        ///< [n_nodes]
  std::vector<int> n_nodes_;  ///< [n_fibers]
};

}  // namespace skein
