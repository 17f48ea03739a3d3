#pragma once

#include <skein/core/kernel_path.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/physics/force.hpp>

#include <memory>
#include <vector>

namespace skein {

template <class Space>
struct SpringArrays;

/// Elastic forces of all fibers' springs.
class SpringForces final : public Force {
 public:
  /// @param path  device: a thread for each node; a host that is asked for this is slow at it
  explicit SpringForces(const std::vector<Fiber>& fibers, KernelPath path = KernelPath::automatic);
  /// @param networks  one for each fiber, their nodes one after the other without gaps
  explicit SpringForces(const std::vector<SpringNetwork>& networks, KernelPath path = KernelPath::automatic);
  ~SpringForces() override;
  SpringForces(SpringForces&&) noexcept;
  SpringForces& operator=(SpringForces&&) noexcept;

  ForcePromises promises() const override;

  /// A spring of length zero adds zero, not NaN.
  void add_forces(double time, const ConstVectors& position, const Vectors& force) const override;
  void compute_forces(double time, const ConstVectors& position, const Vectors& force) const override;
  void add_force_changes(double time, const ConstVectors& position, const ConstVectors& displacement,
                         const Vectors& change) const override;
  void add_forces_on(int first, int n, double time, const SeenNodes& nodes, const Vectors& force) const override;
  void add_force_changes_on(int first, int n, double time, const SeenNodes& nodes,
                            const Vectors& change) const override;
  void add_energies(double time, const ConstVectors& position, std::vector<double>& energy) const override;

  /// The largest |r/l - 1| over all springs, r their length and l that at rest.
  double compute_largest_strain(const ConstVectors& position) const override;
  std::string describe() const override;

 private:
  std::unique_ptr<SpringArrays<ExecSpace>> springs_;
  bool by_nodes_;
  int reach_ = 0;                ///< of the farthest spring, sections
  std::vector<int> n_sections_;  ///< [n_fibers]
  Scalars section_energy_;
};

}  // namespace skein
