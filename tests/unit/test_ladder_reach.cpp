// Which scenes the table of convergence has, and what it says of them: against the rows of perf/ladder.csv, read here.
#include <skein/physics/scene_times.hpp>

#include "studies/ladder_reach.hpp"
#include "studies/ladder_table.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/rung.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace skein {
namespace {

const std::vector<Question> usual{Question::shape, Question::half_period, Question::hook_radius,
                                  Question::snaking_speed};

SceneConfig make_scene(const double length) {
  return resolve_times(make_paper_scene(count_paper_sections(length), find_ladder_end(length)));
}

/// The file's rows: names of columns, without units, and what stands under them.
std::vector<std::map<std::string, double>> read_rows() {
  std::ifstream file(SKEIN_LADDER_CSV);
  std::vector<std::string> names;
  std::vector<std::map<std::string, double>> rows;
  for (std::string line, cell; std::getline(file, line);) {
    std::istringstream cells(line);
    std::map<std::string, double> row;
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i)
      if (rows.empty() && names.size() == i)
        names.push_back(cell.substr(0, cell.find(' ')));
      else
        row[names.at(i)] = std::stod(cell);
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

double find_largest(const std::map<std::string, double>& row) {
  double largest = 0.0;
  for (const char* question : {"shape", "half_period", "hook_radius", "snaking_speed"}) {
    const double error = row.at(std::string(question) + "_error");
    if (!std::isnan(error)) largest = std::max(largest, error);
  }
  return largest;
}

TEST(LadderReach, HasTheErrorsOfTheFile) {
  const auto rows = read_rows();
  ASSERT_GE(rows.size(), 32u);
  std::map<int, double> over_all;
  for (const auto& row : rows) {
    const int rung = static_cast<int>(row.at("nodes_per_section"));
    const auto reach = find_ladder_reach(make_scene(row.at("length")), usual);
    ASSERT_TRUE(reach) << row.at("length");
    EXPECT_EQ(reach->length, row.at("length"));
    EXPECT_EQ(reach->find_seconds(rung), row.at("seconds"));
    over_all[rung] = std::max(over_all[rung], find_largest(row));
    if (rung < 24) {
      EXPECT_EQ(reach->find_error(rung), find_largest(row)) << row.at("length") << ' ' << rung;
    }
  }
  for (const LadderRow& row : list_ladder()) EXPECT_EQ(row.error, over_all.at(row.nodes_per_section));
}

TEST(LadderReach, LiesBetweenItsRungsAndBelowTheNextOnesAtTheFinest) {
  const auto reach = find_ladder_reach(make_scene(0.523), usual);
  ASSERT_TRUE(reach);
  EXPECT_NEAR(reach->find_error(15), 0.5 * (reach->find_error(12) + reach->find_error(18)), 1e-15);
  EXPECT_EQ(reach->find_error(24), 0.5 * reach->find_error(18));
  EXPECT_GT(reach->find_error(21), reach->find_error(24));
  EXPECT_TRUE(std::isnan(reach->find_error(0)));
  const auto only_shape = find_ladder_reach(make_scene(0.523), {Question::shape});
  EXPECT_LT(only_shape->find_error(4), reach->find_error(4));  // whose largest is that of the speed
}

TEST(LadderReach, IsTheSameInOtherUnitsAndOfRungs) {
  const SceneConfig scene = make_scene(0.196);
  SceneConfig other = make_rung_scene(scene, 6);
  constexpr double length = 20.0, time = 0.25, viscosity = 3.0;  // how many of the new units are an old one
  other.fluid.viscosity *= viscosity;
  other.flows[0].rate /= -time;
  other.time.end *= time;
  other.time.tolerance /= time;
  other.fibers[0].radius *= length;
  other.fibers[0].blob *= length;
  other.fibers[0].spacing *= length;
  other.fibers[0].spring_stiffness *= viscosity * length * length / time;
  other.fibers[0].direction = {-3.0, 0.0, 0.0};
  const auto one = find_ladder_reach(scene, usual), same = find_ladder_reach(other, usual);
  ASSERT_TRUE(one && same);
  EXPECT_EQ(one->length, same->length);
  EXPECT_EQ(one->find_error(9), same->find_error(9));
  EXPECT_NEAR(same->time_tolerance, one->time_tolerance / time, 1e-15);
  EXPECT_NEAR(one->time_tolerance, ladder_time_tolerance, 1e-15);
}

TEST(LadderReach, HasNoOtherScenes) {
  const auto expect_none = [&](const auto& change) {
    SceneConfig scene = make_scene(0.523);
    change(scene);
    EXPECT_FALSE(find_ladder_reach(scene, usual));
  };
  expect_none([](SceneConfig& s) { s.fibers[0].sections = 250; });
  expect_none([](SceneConfig& s) { s.fibers[0].spring_stiffness *= 1.1; });
  expect_none([](SceneConfig& s) { s.fibers[0].blob *= 0.9; });
  expect_none([](SceneConfig& s) { s.fibers[0].direction = {1.0, 1e-3, 0.0}; });
  expect_none([](SceneConfig& s) { s.fibers[0].start_noise = 1e-4; });
  expect_none([](SceneConfig& s) { s.fibers[0].start_amplitude = 1e-4; });
  expect_none([](SceneConfig& s) { s.fibers[0].model = FiberModel::rigid; });
  expect_none([](SceneConfig& s) { s.fibers.push_back(s.fibers[0]); });
  expect_none([](SceneConfig& s) { s.flows[0].kind = FlowKind::planar_extension; });
  expect_none([](SceneConfig& s) { s.flows[0].rate *= 1.1; });
  expect_none([](SceneConfig& s) { s.gravity.weight = 1.0; });
  expect_none([](SceneConfig& s) { s.repulsion.strength = 1.0; });
  expect_none([](SceneConfig& s) { s.time.end = 27.0; });  // past what the table has seen
  expect_none([](SceneConfig& s) { s.time.end = 15.0; });  // where errors are not yet what the table has
  expect_none([](SceneConfig& s) { s.time.tolerance = 1e-3; });
  expect_none([](SceneConfig& s) { s.time.step = 1e-3; });
  expect_none([](SceneConfig& s) { s.hydrodynamics.tolerance = 1e-3; });
  EXPECT_FALSE(find_ladder_reach(make_scene(0.523), {Question::shape, Question::contact}));
}

}  // namespace
}  // namespace skein
