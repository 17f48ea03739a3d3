#include <skein/core/duration.hpp>

#include "cli/progress.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(Duration, ReadsWhatPeopleWrite) {
  EXPECT_EQ(parse_duration("90"), 90.0);
  EXPECT_EQ(parse_duration("1.5h"), 5400.0);
  EXPECT_EQ(parse_duration("30m"), 1800.0);
  EXPECT_EQ(parse_duration("2d"), 172800.0);
  EXPECT_EQ(parse_duration("1:30"), 90.0);
  EXPECT_EQ(parse_duration("2:00:05"), 7205.0);
  for (const char* wrong : {"", "0", "-1", "inf", "nan", "h", "3x", "1:60", "1:2:3:4", "1:", ":1", "1e999", "1 h"}) {
    EXPECT_FALSE(parse_duration(wrong)) << wrong;
  }
}

TEST(Duration, IsWrittenShort) {
  EXPECT_EQ(format_duration(0.4), "0 s");
  EXPECT_EQ(format_duration(185.2), "3 min 05 s");
  EXPECT_EQ(format_duration(7800.0), "2 h 10 min");
  EXPECT_EQ(format_duration(86400.0 * 5 + 3 * 3600.0), "5 d 03 h");
}

TEST(Progress, RatesCountFromTheStartOfThisProcess) {
  RunProgress progress{2.0, 5.0, 12.0, 1000, 1600, 30.0};
  EXPECT_EQ(describe_progress(progress), "t = 5 of 12 (41 %), 1 min 10 s left, 0.1 per s, 20 evaluations/s");
}

TEST(Progress, HasNoRatesBeforeTheFirstStep) {
  EXPECT_EQ(describe_progress({2.0, 2.0, 12.0, 1000, 1000, 3.0}), "t = 2 of 12 (16 %)");
  EXPECT_EQ(describe_progress({0.0, 0.0, 0.0, 0, 0, 0.0}), "t = 0 of 0 (100 %)");
}

TEST(Progress, BarFillsAtTheEndOnly) {
  EXPECT_EQ(draw_bar(0.0, 4), "[....]");
  EXPECT_EQ(draw_bar(0.99, 4), "[###.]");
  EXPECT_EQ(draw_bar(1.0, 4), "[####]");
  EXPECT_EQ(draw_bar(7.0, 4), "[####]");
}

}  // namespace
}  // namespace skein
