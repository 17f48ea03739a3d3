// What the JSON writer writes, letter by letter; check_json.py reads it back.
#include <skein/core/error.hpp>
#include <skein/core/json.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

namespace skein {
namespace {

template <class Value>
std::string write(const Value& value) {
  return JsonWriter().value(value).take();
}

TEST(Json, TextIsUtf8WhateverItsBytes) {
  EXPECT_EQ(write("a\"b\\c\n\x01"), R"("a\"b\\c\u000a\u0001")");
  EXPECT_EQ(write(std::string("\0", 1)), R"("\u0000")");
  EXPECT_EQ(write("\xc3\xa9 \xe2\x82\xac \xf0\x9f\xa7\xb6"), "\"\xc3\xa9 \xe2\x82\xac \xf0\x9f\xa7\xb6\"");
  EXPECT_EQ(write("caf\xe9s"), R"("caf\ufffds")");                        // Latin-1
  EXPECT_EQ(write("\xc3"), R"("\ufffd")");                                // cut short
  EXPECT_EQ(write("\xc0\xaf"), R"("\ufffd\ufffd")");                      // "/" in two bytes
  EXPECT_EQ(write("\xe0\x80\xaf"), R"("\ufffd\ufffd\ufffd")");            // in three
  EXPECT_EQ(write("\xed\xa0\x80"), R"("\ufffd\ufffd\ufffd")");            // a surrogate
  EXPECT_EQ(write("\xf4\x90\x80\x80"), R"("\ufffd\ufffd\ufffd\ufffd")");  // beyond U+10FFFF
}

TEST(Json, RealsReadBackAndTellThemselvesFromCounts) {
  EXPECT_EQ(write(0.1), "0.1");
  EXPECT_EQ(write(5.0), "5.0");
  EXPECT_EQ(write(-0.0), "-0.0");
  EXPECT_EQ(write(1e308), "1e+308");
  EXPECT_EQ(write(5e-324), "5e-324");
  EXPECT_EQ(write(0.1 + 0.2), "0.30000000000000004");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double number : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(write(number), "null");
  EXPECT_EQ(write(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(write(std::numeric_limits<std::int64_t>::max()), "9223372036854775807");
  EXPECT_EQ(write(true), "true");
}

TEST(Json, NestsOnOneLineOrOnSeveral) {
  const auto nest = [](JsonWriter json) {
    json.begin_object().member("time", 0.5).key("none").null().key("points").begin_array();
    for (const int point : {1, 2}) json.begin_array().value(point).end_array();
    json.begin_object().end_object().end_array().member("last", "x");
    return json.end_object().take();
  };
  EXPECT_EQ(nest(JsonWriter()), R"({"time": 0.5, "none": null, "points": [[1], [2], {}], "last": "x"})");
  EXPECT_EQ(nest(JsonWriter(2)), R"({
  "time": 0.5,
  "none": null,
  "points": [
    [1],
    [2],
    {}
  ],
  "last": "x"
})");
}

TEST(Json, RefusesWhatIsNoJson) {
  EXPECT_THROW(JsonWriter().end_object(), Error);
  EXPECT_THROW(JsonWriter().key("lonely"), Error);
  EXPECT_THROW(JsonWriter().value(1).value(2), Error);
  EXPECT_THROW(JsonWriter().begin_object().value(1), Error);
  EXPECT_THROW(JsonWriter().begin_object().key("a").key("b"), Error);
  EXPECT_THROW(JsonWriter().begin_object().key("a").end_object(), Error);
  EXPECT_THROW(JsonWriter().begin_array().end_object(), Error);
  EXPECT_THROW(JsonWriter().begin_array().take(), Error);
  EXPECT_THROW(JsonWriter().take(), Error);
}

}  // namespace
}  // namespace skein
