#pragma once

#include <skein/core/kernel_path.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/physics/force.hpp>

#include <memory>
#include <vector>

namespace skein {

template <class Space>
struct SpringArrays;
template <class Space>
struct SpringMeasures;

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
  void seek_measures(double time, const ConstVectors& position) const override;
  void add_found_energies(std::vector<double>& energy) const override;
  /// |r/l - 1|, r the length of a spring and l that at rest.
  double found_largest_strain() const override;
  std::string describe() const override;

 private:
  std::unique_ptr<SpringArrays<ExecSpace>> springs_;
  bool by_nodes_;
  int reach_ = 0;                ///< of the farthest spring, sections
  std::vector<int> n_sections_;  ///< [n_fibers]
  std::unique_ptr<SpringMeasures<ExecSpace>> measures_;
};

}  // namespace skein
