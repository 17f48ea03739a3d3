#pragma once

#include <skein/arrays/node_vectors.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/physics/node_symmetry.hpp>
#include <skein/solvers/linearization.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace skein {

class BlockBand;

/// A = M(x) dF/dx of fibers. Its preconditioner keeps the mobility between sections that are near each other on a
/// fiber, fewer where sums are cheap, tapered, as a banded matrix factorized on the host; with every section's frame it
/// turns, so that it serves while the fiber rotates and bends on.
class FiberLinearization final : public Linearization {
 public:
  /// Overwrites result with M(position) dF/dx(time, position) displacement.
  using Product = std::function<void(double time, const ConstVectors& position, const ConstVectors& displacement,
                                     const Vectors& result)>;

  /// What has made an array that the linearization is given.
  using VectorsOf = std::function<NodeVectors&(const ConstVectors& vectors)>;

  /// @param relative_sum_cost  of a velocity's sum, see Mobility::relative_cost
  /// @param symmetry  that products keep, and so what the preconditioner makes of them; null: none
  FiberLinearization(const std::vector<Fiber>& fibers, double viscosity, double relative_sum_cost, Product product,
                     VectorsOf vectors_of, std::shared_ptr<const NodeSymmetry> symmetry);
  ~FiberLinearization() override;

  void set_position(double time, const ConstVectors& position) override;
  void multiply(const ConstVectors& v, const Vectors& result) override;
  bool factorize(const ConstVectors& position, double scale) override;
  PreconditionerCost preconditioner_cost() const override;
  void precondition(const ConstVectors& v, const Vectors& result) override;
  std::string describe() const override;

 private:
  /// Rows: along the fiber, towards node 0, and across both.
  struct Frame {
    Vec3 axis[3];
  };
  std::vector<Frame> make_frames(const std::vector<Vec3>& position) const;
  void update_turns();

  std::vector<Fiber> fibers_;
  std::vector<SpringNetwork> networks_;
  double viscosity_;
  Product product_;
  VectorsOf vectors_of_;
  std::shared_ptr<const NodeSymmetry> symmetry_;
  int n_nodes_, near_sections_;
  double evaluation_operations_;  ///< of a velocity
  double time_ = 0.0;
  Vectors position_;
  std::vector<Frame> frames_, frames_at_factorization_;  ///< [n_sections]
  std::vector<Frame> turns_;                             ///< rows of the rotations since the factorization
  std::vector<std::unique_ptr<BlockBand>> bands_;        ///< [n_fibers]
};

}  // namespace skein
