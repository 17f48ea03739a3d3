#include <skein/core/error.hpp>
#include <skein/scene/sweep_file.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <string>

namespace skein {
namespace {

class SweepFile : public testing::Test {
 protected:
  SweepConfig read(const std::string& content) {
    const auto path = folder_ / "sweep.toml";
    std::ofstream(path) << content;
    return read_sweep(path);
  }

  static std::string parameter(const std::string& key, const std::string& rest) {
    return "[[parameter]]\nkey = \"" + key + "\"\n" + rest + "\n";
  }

  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path();
};

TEST_F(SweepFile, RangesHoldTheirEnds) {
  const auto sweep = read("scene = \"a.toml\"\n" + parameter("flow.rate", "from = 0.1\nto = 0.7\ncount = 7") +
                          parameter("fiber.roll", "from = 1e-3\nto = 10\ncount = 5\nspacing = \"logarithmic\""));
  const auto& linear = sweep.parameters[0].values;
  ASSERT_EQ(linear.size(), 7u);
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(linear[i].number, 0.1 * (i + 1), 1e-15);
  EXPECT_EQ(linear.front().text, "0.1");
  EXPECT_EQ(linear.back().text, "0.7");
  const auto& logarithmic = sweep.parameters[1].values;
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(std::log10(logarithmic[i].number), i - 3.0, 1e-14);
  EXPECT_EQ(logarithmic.back().text, "10.0");
}

TEST_F(SweepFile, IntegersStayIntegers) {
  const auto sweep = read("scene = \"a.toml\"\n" + parameter("fiber.sections", "from = 10\nto = 20\ncount = 3") +
                          parameter("seed", "from = 1\nto = 1000000\ncount = 50\nspacing = \"random\""));
  EXPECT_EQ(sweep.parameters[0].values[1].text, "15");
  std::set<std::string> seeds;
  for (const SweepValue& value : sweep.parameters[1].values) {
    EXPECT_EQ(value.text.find_first_not_of("0123456789"), std::string::npos) << value.text;
    seeds.insert(value.text);
  }
  EXPECT_GE(seeds.size(), 49u);
}

TEST_F(SweepFile, DrawsAreEvenOnTheirScale) {
  const auto sweep =
      read("scene = \"a.toml\"\ncombine = \"zipped\"\nseed = 5\n" +
           parameter("flow.rate", "from = 2\nto = 6\ncount = 4000\nspacing = \"random\"") +
           parameter("fiber.roll", "from = 1\nto = 100\ncount = 4000\nspacing = \"random_logarithmic\""));
  double sum = 0.0, logarithms = 0.0, product = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double even = (sweep.parameters[0].values[i].number - 2.0) / 4.0;
    const double logarithm = std::log10(sweep.parameters[1].values[i].number) / 2.0;
    ASSERT_TRUE(even >= 0.0 && even < 1.0 && logarithm >= 0.0 && logarithm < 1.0);
    sum += even, logarithms += logarithm, product += even * logarithm;
  }
  // Five standard deviations of means of 4000.
  EXPECT_NEAR(sum / 4000.0, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / 4000.0));
  EXPECT_NEAR(logarithms / 4000.0, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / 4000.0));
  EXPECT_NEAR(product / 4000.0, 0.25, 5.0 * std::sqrt(7.0 / 144.0 / 4000.0));  // of independent ones
}

TEST_F(SweepFile, EachCombinationIsThereOnce) {
  const auto sweep =
      read("scene = \"a.toml\"\nchanges = [\"time.end=2.0\"]\n" + parameter("fiber.sections", "values = [8, 10]") +
           parameter("flow.rate", "values = [1.0, 2.0, 3.0]") +
           parameter("fiber.roll", "values = [0, 5]\nwith = \"fiber.sections\"") +
           parameter("hydrodynamics.precision", "values = [\"double\", \"single\"]"));
  ASSERT_EQ(count_sweep_runs(sweep), 12u);
  std::set<std::string> runs;
  for (std::size_t run = 0; run < 12; ++run) {
    const auto overrides = make_sweep_overrides(sweep, run);
    ASSERT_EQ(overrides.size(), 5u);
    EXPECT_EQ(overrides[0], "time.end=2.0");
    EXPECT_EQ(overrides[1] == "fiber.sections=8", overrides[3] == "fiber.roll=0");
    std::string all;
    for (const std::string& override : overrides) all += override + " ";
    runs.insert(all);
  }
  EXPECT_EQ(runs.size(), 12u);
  EXPECT_EQ(make_sweep_overrides(sweep, 1)[4], "hydrodynamics.precision=\"single\"");  // the last one changes first
}

TEST_F(SweepFile, ProfilesAndLongListsAreKeptWhole) {
  std::string numbers;
  for (int i = 0; i < 500; ++i) numbers += std::to_string(i) + ", ";
  const auto sweep = read("scene = \"a.toml\"\n" + parameter("fiber.roll", "values = [" + numbers + "]") +
                          parameter("fiber.stiffness_profile", "values = [[[0.0, 1.0], [1.0, 0.5]]]"));
  EXPECT_EQ(sweep.parameters[0].values.size(), 500u);
  EXPECT_EQ(sweep.parameters[1].values[0].text, "[[0.0, 1.0], [1.0, 0.5]]");
}

TEST_F(SweepFile, TooManyRunsAreRefused) {
  const std::string content = "scene = \"a.toml\"\n" + parameter("seed", "from = 1\nto = 1000\ncount = 1000") +
                              parameter("flow.rate", "from = 1\nto = 2\ncount = 101");
  EXPECT_EQ(code_of([&] { read(content); }), ExitCode::scene_error);
}

TEST(SweepPicture, IsSaidInWords) {
  const SweepPicture curve = read_sweep_picture("half_period over fiber.sections by flow.rate");
  EXPECT_EQ(curve.value, "half_period");
  EXPECT_EQ(curve.x, "fiber.sections");
  EXPECT_EQ(curve.by, "flow.rate");
  EXPECT_EQ(read_sweep_picture("regime over a and b").y, "b");
  for (const char* words : {"", "regime", "regime over", "regime of a", "regime over a or b", "regime over a and"})
    EXPECT_EQ(code_of([&] { read_sweep_picture(words); }), ExitCode::usage) << words;
}

}  // namespace
}  // namespace skein
