#pragma once

#include <skein/core/number_visitor.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/io/trajectory.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// Watches for what the model cannot resolve: hooks sharper than the sections' spacing, springs strained by more than a
/// half, fibers (or distant sections of one) closer than a film that the fluid resolves, inside of each other, or
/// across each other. The film is a blob; of lines, whose blob stands for the whole thickness of the fiber, a radius.
/// Each kind is told once, and counted by steps.
class ModelGuard {
 public:
  /// @param has_repulsion  something keeps fibers apart, if it is strong enough
  explicit ModelGuard(const std::vector<Fiber>& fibers, bool has_repulsion = false);

  /// @param record  of the step, with its observables
  /// @param largest_strain  |r/l - 1| over the springs
  /// @returns what was met for the first time, a sentence each
  std::vector<std::string> look(const StepRecord& record, double largest_strain);

  /// What was met in the whole run, for its end; empty where nothing was.
  std::string describe() const;

  void visit_memory(NumberVisitor& visitor);

 private:
  enum Kind { sharp_hook, strained_spring, contact, penetration, crossing };
  static constexpr int n_kinds = 5;

  std::vector<double> spacing_;  ///< [n_fibers], length
  double film_ = 0.0;            ///< the thickest of all fibers, length
  std::string film_name_;        ///< "blob" or "radius"
  bool has_repulsion_;
  std::array<std::int64_t, n_kinds> n_steps_{};
  std::array<double, n_kinds> worst_{};  ///< curvature times spacing; strain; gap / film; depth / film; count
  std::int64_t most_inside_ = 0;         ///< nodes inside of surfaces in one step
};

}  // namespace skein
