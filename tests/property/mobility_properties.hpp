#pragma once

#include <skein/physics/mobility.hpp>

#include "tests/property/random_fluid.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

namespace skein {

/// One implementation of Mobility. The table of all stands at the end of test_mobility.cpp.
struct Row {
  const char* name;
  std::function<std::unique_ptr<Mobility>(double viscosity)> make;
  double tolerance;  ///< error of a velocity over the largest velocity
};

inline std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.name; }

class MobilityProperties : public ::testing::TestWithParam<Row> {
 protected:
  double tolerance() const { return GetParam().tolerance; }

  /// Velocities at other points than the sources' own array, even where these are equal.
  std::vector<Vec3> compute_at(const reference::PointForces& from, const std::vector<Vec3>& target,
                               const double viscosity) const {
    const Vectors velocity("test::velocity", target.size());
    mobility_of(viscosity).add_velocity(on_device(from), to_device("test::target", target), velocity);
    return to_host(velocity);
  }

  /// Velocities of the sources: the targets are the same array.
  std::vector<Vec3> compute(const reference::PointForces& from, const double viscosity) const {
    const Sources sources = on_device(from);
    const Vectors velocity("test::velocity", from.position.size());
    mobility_of(viscosity).add_velocity(sources, sources.position, velocity);
    return to_host(velocity);
  }

  static Sources on_device(const reference::PointForces& from) {
    return {to_device("test::position", from.position), to_device("test::force", from.force),
            to_device("test::blob", from.blob)};
  }

  /// Kept for the few viscosities that are drawn: to make some takes far longer than to use them.
  static Mobility& mobility_of(const double viscosity) {
    std::unique_ptr<Mobility>& mobility = kept_[{GetParam().name, viscosity}];
    if (mobility == nullptr) mobility = GetParam().make(viscosity);
    return *mobility;
  }
  static void TearDownTestSuite() { kept_.clear(); }

 private:
  static inline std::map<std::pair<std::string, double>, std::unique_ptr<Mobility>> kept_;
};

}  // namespace skein
