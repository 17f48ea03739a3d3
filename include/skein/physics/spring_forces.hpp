#pragma once

#include <skein/arrays/types.hpp>
#include <skein/fibers/spring_network.hpp>

#include <memory>
#include <vector>

namespace skein {

template <class Space>
struct SpringArrays;

/// Elastic forces of all fibers' springs, on the device.
///
/// Forces and energies do not depend on the number of threads. One call at a time: the object holds scratch.
class SpringForces {
 public:
  explicit SpringForces(const std::vector<Fiber>& fibers);
  /// @param networks  one for each fiber, their nodes one after the other without gaps
  explicit SpringForces(const std::vector<SpringNetwork>& networks);
  ~SpringForces();
  SpringForces(SpringForces&&) noexcept;
  SpringForces& operator=(SpringForces&&) noexcept;

  /// Overwrites force with the springs' force on each node; zero, not NaN, from a spring of length zero.
  /// @param position, force  [n_nodes, 3], length and force
  /// @throws Error(internal) if the extents are not those of the fibers. Returns before a device has finished.
  void compute_forces(const ConstVectors& position, const Vectors& force) const;

  /// Overwrites change with the first-order change of the forces when nodes move by `displacement`.
  /// @param position, displacement, change  [n_nodes, 3], length, length and force
  void compute_force_changes(const ConstVectors& position, const ConstVectors& displacement,
                             const Vectors& change) const;

  /// The largest |r/l - 1| over all springs, r their length and l that at rest.
  double compute_largest_strain(const ConstVectors& position) const;

  /// Elastic energy of each fiber, force * length. @returns [n_fibers]
  std::vector<double> compute_energies(const ConstVectors& position) const;

 private:
  std::unique_ptr<SpringArrays<ExecSpace>> springs_;
  std::vector<int> n_sections_;  ///< [n_fibers]
  Scalars section_energy_;
};

}  // namespace skein
