// Points from texts, and where a wrong one is wrong.

#include <skein/io/point_file.hpp>

#include "tests/support/nan_trap.hpp"
#include "tests/unit/error_code.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

TEST(PointFile, TakesBlanksCommasSemicolonsCommentsAndAHeading) {
  const std::vector<Vec3> expected = {{1.0, -2.5, 0.0}, {0.25, 3e-4, -1e10}};
  for (const char* text :
       {"1 -2.5 0\n.25 3e-4 -1e10\n", "1,-2.5,0\n.25,3e-4,-1e10", "x,y,z\r\n1, -2.5, 0\r\n.25;3e-4;-1e10\r\n",
        "\xef\xbb\xbfx y z\n\n# probes\n+1\t-2.5\t+0 # the first\n  .25 , 3e-4 , -1e10  \n\n"})
    EXPECT_EQ(parse_points(text, "points"), expected) << text;
}

TEST(PointFile, NamesLineAndColumnOfWhatIsWrong) {
  const test::MeantNan coordinates_that_are_none;
  const struct {
    const char *text, *where, *what;
  } cases[] = {
      {"1 2 3\n1 two 3\n", "p.csv:2:3", "'two'"},
      {"1 2\n", "p.csv:1:3", "only 2 values"},
      {"0 0 0\n1,2,3,4\n", "p.csv:2:7", "a fourth value"},
      {"1,,3\n", "p.csv:1:3", "missing before"},
      {",1,2,3\n", "p.csv:1:1", "missing before"},
      {"1,2,3,\n", "p.csv:1:6", "missing after"},
      {"1 2 nan\n", "p.csv:1:5", "'nan' is no coordinate"},
      {"-inf 2 3\n", "p.csv:1:1", "no coordinate"},
      {"1 1e999 2\n", "p.csv:1:3", "no number"},
      {"1 2 -1e101\n", "p.csv:1:5", "1e+100"},
      {"0x10 2 3\n", "p.csv:1:1", "'0x10'"},
      {"1 2 3\nx y z\n", "p.csv:2:1", "'x'"},
      {"x y z\nx y z\n", "p.csv:2:1", "'x'"},
      {"1 2 3\n1 \x1b[31m 3\n", "p.csv:2:3", "'?[31m'"},
      {"", "p.csv:1:1", "no point"},
      {"# nothing\n\n", "p.csv:2:1", "no point"},
  };
  for (const auto& wrong : cases) {
    std::string message;
    EXPECT_EQ(code_of([&] { parse_points(wrong.text, "p.csv"); }, &message), ExitCode::damaged_data) << wrong.text;
    EXPECT_EQ(message.find(std::string(wrong.where) + ": "), 0u) << wrong.text << " gives " << message;
    EXPECT_NE(message.find(wrong.what), std::string::npos) << wrong.text << " gives " << message;
  }
}

TEST(PointFile, SaysThatAFileIsNotThere) {
  std::string message;
  EXPECT_EQ(code_of([] { read_points("/nowhere/points.csv"); }, &message), ExitCode::missing_input);
  EXPECT_NE(message.find("/nowhere/points.csv"), std::string::npos);
}

}  // namespace
}  // namespace skein
