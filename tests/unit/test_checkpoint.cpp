// Checkpoint files: what they hold comes back, and no damage passes.

#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace skein {
namespace {

Checkpoint make_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.set("a number", std::vector<double>{0.1});
  checkpoint.set("a list", std::vector<double>{1.0, -0.0, 5e-324, std::numeric_limits<double>::infinity()});
  checkpoint.set("an empty list", std::vector<double>{});
  checkpoint.set("an integer", std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::min()});
  checkpoint.set("a text", std::string("of 9 byte"));
  checkpoint.set("an empty text", std::string());
  return checkpoint;
}

TEST(Checkpoint, ComesBackInEveryBit) {
  const Checkpoint before = make_checkpoint();
  const Checkpoint after = decode_checkpoint(encode_checkpoint(before));
  EXPECT_EQ(after.values(), before.values());
  EXPECT_EQ(after.number("a number"), 0.1);
  EXPECT_TRUE(std::signbit(after.numbers("a list")[1]));
  EXPECT_EQ(after.integer("an integer"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(after.text("a text"), "of 9 byte");
  EXPECT_EQ(decode_checkpoint(encode_checkpoint({})).values().size(), 0u);
}

TEST(Checkpoint, NamesWhatIsMissingOrOfAnotherKind) {
  const Checkpoint checkpoint = make_checkpoint();
  std::string message;
  EXPECT_EQ(code_of([&] { checkpoint.number("nothing"); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find("'nothing'"), std::string::npos);
  for (const char* name : {"a list", "an empty list", "an integer", "a text"})
    EXPECT_EQ(code_of([&] { checkpoint.number(name); }), ExitCode::damaged_data) << name;
  EXPECT_EQ(code_of([&] { checkpoint.integer("a number"); }), ExitCode::damaged_data);
  EXPECT_EQ(code_of([&] { checkpoint.text("a number"); }), ExitCode::damaged_data);
}

TEST(Checkpoint, EveryFlippedBitAndEveryLengthIsFound) {
  const std::string whole = encode_checkpoint(make_checkpoint());
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    ASSERT_EQ(code_of([&] { decode_checkpoint(damaged); }), ExitCode::damaged_data) << "bit " << bit;
  }
  for (std::size_t length = 0; length < whole.size(); ++length)
    ASSERT_EQ(code_of([&] { decode_checkpoint(whole.substr(0, length)); }), ExitCode::damaged_data) << length;
  EXPECT_EQ(code_of([&] { decode_checkpoint(whole + '\0'); }), ExitCode::damaged_data);
}

// A right checksum over a wrong content, as no accident makes it: sizes must be checked all the same.
TEST(Checkpoint, SealedNonsenseIsRefused) {
  const std::string whole = encode_checkpoint(make_checkpoint());
  std::mt19937_64 random(3);
  int n_refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string content = whole.substr(0, whole.size() - 16);
    const std::size_t at = 8 + random() % (content.size() - 8);
    content[at] = static_cast<char>(random());
    if (random() % 2 == 0) content.replace(8 * (random() % (content.size() / 8)), 8, std::string(8, '\xff'));
    n_refused += code_of([&] { decode_checkpoint(content + compute_seal(content)); }) == ExitCode::damaged_data;
  }
  EXPECT_GT(n_refused, 5000);
}

TEST(Checkpoint, ReadingNamesTheFile) {
  const ScratchFolder scratch;
  const auto path = scratch.path() / "000007.checkpoint";
  write_file_atomically(path, encode_checkpoint(make_checkpoint()));
  EXPECT_EQ(read_checkpoint(path).number("a number"), 0.1);
  write_file_atomically(path, encode_checkpoint(make_checkpoint()).substr(0, 60));
  std::string message;
  EXPECT_EQ(code_of([&] { read_checkpoint(path); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find(path.string()), std::string::npos);
  EXPECT_NE(message.find("60 bytes"), std::string::npos);
}

}  // namespace
}  // namespace skein
