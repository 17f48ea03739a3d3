// What titles, names and hosts may do to a terminal: nothing.
#include <skein/core/json.hpp>
#include <skein/core/terminal_text.hpp>

#include <gtest/gtest.h>

#include <string>

namespace skein {
namespace {

TEST(TerminalText, LettersOfAllLanguagesStay) {
  for (const std::string text : {"", "plain: 'a' \\ 100 %", "\xc3\xa9\xc3\xa4 \xe2\x82\xac", "\xe7\xba\xa4\xe7\xbb\xb4",
                                 "\xd7\xa1\xd7\x99\xd7\x91", "\xf0\x9f\xa7\xb6"})
    EXPECT_EQ(make_terminal_line(text), text);
  EXPECT_EQ(make_terminal_text("two\n\tlines\n"), "two\n\tlines\n");
}

TEST(TerminalText, ControlsAreWrittenOut) {
  EXPECT_EQ(make_terminal_text("\033]0;title\007\033[2J"), R"(\x1b]0;title\x07\x1b[2J)");
  EXPECT_EQ(make_terminal_text("over\rwritten\b\x7f"), R"(over\x0dwritten\x08\x7f)");
  EXPECT_EQ(make_terminal_text(std::string("a\0b", 3)), R"(a\x00b)");
  EXPECT_EQ(make_terminal_line("one\ntwo\t"), R"(one\x0atwo\x09)");
}

// Terminals of 8 bits take the bytes 0x80 to 0x9f for controls, others their characters of two bytes.
TEST(TerminalText, C1AsBytesAndAsCharacters) {
  EXPECT_EQ(make_terminal_text("\x9b"
                               "31m"),
            R"(\x9b31m)");
  EXPECT_EQ(make_terminal_text("\xc2\x9b"
                               "31m"),
            R"(\u009b31m)");
  EXPECT_EQ(make_terminal_text("caf\xe9"), R"(caf\xe9)");
  EXPECT_EQ(make_terminal_text("\xc0\x9b"), R"(\xc0\x9b)");  // ESC's relative in an overlong form
}

TEST(TerminalText, MarksOfDirectionAndSeparatorsAreWrittenOut) {
  EXPECT_EQ(make_terminal_text("a\xe2\x80\xae"
                               "b\xe2\x81\xa6"
                               "c\xd8\x9c"
                               "d\xe2\x80\xa8"),
            R"(a\u202eb\u2066c\u061cd\u2028)");
}

TEST(TerminalText, NoByteThatATerminalActsOnIsLeft) {
  for (int first = 0; first < 256; ++first)
    for (int second = 0; second < 256; ++second) {
      const std::string text = {static_cast<char>(first), static_cast<char>(second)};
      const std::string shown = make_terminal_line(text);
      EXPECT_EQ(make_terminal_line(shown), shown) << first << " " << second;
      for (const char c : shown)
        EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << first << " " << second;
    }
}

TEST(TerminalText, JsonNeedsNoOther) {
  const std::string json = JsonWriter().value("\033[31m\x7f\xc2\x9b\xe2\x80\xae \xc3\xa9\n\x9b").take();
  EXPECT_EQ(json, "\"\\u001b[31m\\u007f\\u009b\\u202e \xc3\xa9\\u000a\\ufffd\"");
  EXPECT_EQ(make_terminal_text(json), json);
}

}  // namespace
}  // namespace skein
