// What a run's frames say of surfaces that meet: synthetic histories, whose answers are written beside them.
#include <skein/fibers/fiber.hpp>

#include "studies/contact_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr double radius = 0.01;

RunAnalysis make_analysis(const int nodes_per_section) {
  RunAnalysis analysis;
  FiberConfig fiber, thick;
  fiber.radius = radius;
  fiber.nodes_per_section = nodes_per_section;
  if (nodes_per_section == 1) fiber.model = FiberModel::chain;
  thick.radius = 3.0 * radius;
  analysis.fibers = make_fibers({thick, fiber});
  analysis.time = {0.0, 0.5, 1.0, 1.5};
  analysis.smallest_gap = {4.0 * radius, 1.0 * radius, -0.5 * radius, -0.25 * radius};
  analysis.nodes_inside = {0, 0, 3, 1};
  analysis.depth = {0.0, 0.0, 0.125 * radius, 0.0625 * radius};
  analysis.crossings = {0, 0, 0, 0};
  return analysis;
}

TEST(ContactRecord, OfTubesIsTheDeepestNodeInRadiiOfTheThinnestFiber) {
  const ContactRecord contact = record_contact(make_analysis(6));
  EXPECT_DOUBLE_EQ(contact.depth, 0.125);
  EXPECT_DOUBLE_EQ(contact.smallest_gap, -0.5);
  EXPECT_EQ(contact.first_inside, 1.0);
  EXPECT_FALSE(contact.has_crossed());
  EXPECT_EQ(describe_contact(contact), "surfaces are pressed into each other from t = 1 on, 0.12 radii deep");
}

TEST(ContactRecord, OfChainsIsTheOverlapOfTheTubesAboutThem) {
  RunAnalysis analysis = make_analysis(1);
  analysis.depth.assign(4, 0.0);  // they have no surface to be inside of
  const ContactRecord contact = record_contact(analysis);
  EXPECT_DOUBLE_EQ(contact.depth, 0.5);
  EXPECT_EQ(contact.first_inside, 1.0);
}

TEST(ContactRecord, TellsTheFirstCrossing) {
  RunAnalysis analysis = make_analysis(6);
  analysis.crossings = {0, 0, 0, 2};
  const ContactRecord contact = record_contact(analysis);
  EXPECT_TRUE(contact.has_crossed());
  EXPECT_EQ(contact.first_crossing, 1.5);
  EXPECT_EQ(describe_contact(contact), "fibers pass through each other at t = 1.5");
}

TEST(ContactRecord, OfSurfacesApartHasNoTimes) {
  RunAnalysis analysis = make_analysis(6);
  analysis.smallest_gap.assign(4, 2.5 * radius);
  analysis.depth.assign(4, 0.0);
  ContactRecord contact = record_contact(analysis);
  EXPECT_EQ(contact.depth, 0.0);
  EXPECT_TRUE(std::isnan(contact.first_inside));
  EXPECT_EQ(describe_contact(contact), "surfaces stay 2.5 radii apart");
  analysis.smallest_gap.assign(4, std::numeric_limits<double>::infinity());
  EXPECT_EQ(describe_contact(record_contact(analysis)), "no surface is near another");
}

}  // namespace
}  // namespace skein
