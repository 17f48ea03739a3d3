#include <gtest/gtest.h>

#include <skein/core/error.hpp>
#include <skein/model/background_flow.hpp>
#include <skein/model/linear_flow.hpp>

namespace skein {
namespace {

const std::vector<Vec3> positions = {{0.3, -1.5, 2.0}, {4.0, 0.25, -0.7}};
const std::vector<Vec3> initial = {{0.1, 0.2, 0.3}, {-0.4, 0.5, 0.6}};

/// What the flow adds to a velocity that is not zero.
std::vector<Vec3> added_by(const BackgroundFlow& flow) {
  const Vectors velocity = to_device("velocity", initial);
  flow.add_velocity(3.7, to_device("position", positions), velocity);
  std::vector<Vec3> added = to_host(velocity);
  for (std::size_t i = 0; i < added.size(); ++i) added[i] = added[i] - initial[i];
  return added;
}

void expect_near(const Vec3 found, const Vec3 expected) { EXPECT_LT(norm(found - expected), 1e-14); }

TEST(BackgroundFlow, ShearIsAlongXAndGrowsWithY) {
  const auto flow = make_background_flow({.kind = "shear", .rate = 2.5});
  const auto added = added_by(*flow);
  expect_near(added[0], {-3.75, 0, 0});
  expect_near(added[1], {0.625, 0, 0});
  EXPECT_NE(flow->describe().find("2.5"), std::string::npos);
}

TEST(BackgroundFlow, NoneAddsNothing) {
  const auto flow = make_background_flow({.kind = "none", .rate = 2.5});
  for (const Vec3 u : added_by(*flow)) EXPECT_EQ(u, (Vec3{}));
}

TEST(BackgroundFlow, UnknownKindNamesTheKnownOnes) {
  try {
    make_background_flow({.kind = "vortex", .rate = 1.0});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    EXPECT_NE(std::string(error.what()).find("vortex"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("shear"), std::string::npos);
  }
}

TEST(LinearFlow, EveryEntryOfTheGradientAndTheOriginCount) {
  const LinearFlow flow({{{1.5, -2.0, 0.5}, {3.0, -4.0, 0.25}, {7.0, 0.75, 2.5}}}, {1.0, 2.0, -1.0});
  const auto added = added_by(flow);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 d = positions[i] - Vec3{1.0, 2.0, -1.0};
    expect_near(added[i], {1.5 * d.x - 2.0 * d.y + 0.5 * d.z, 3.0 * d.x - 4.0 * d.y + 0.25 * d.z,
                           7.0 * d.x + 0.75 * d.y + 2.5 * d.z});
  }
  EXPECT_NE(flow.describe().find("0.75"), std::string::npos);
}

TEST(LinearFlow, PlanarExtensionCompressesAlongX) {
  const auto added = added_by(LinearFlow(make_planar_extension_gradient(0.8), {}));
  for (std::size_t i = 0; i < positions.size(); ++i)
    expect_near(added[i], {-0.8 * positions[i].x, 0.8 * positions[i].y, 0.0});
}

TEST(LinearFlow, RefusesArraysOfDifferentLength) {
  const LinearFlow flow(make_shear_gradient(2.0), {});
  EXPECT_THROW(flow.add_velocity(0.0, Vectors("position", 3), Vectors("velocity", 2)), Error);
}

}  // namespace
}  // namespace skein
