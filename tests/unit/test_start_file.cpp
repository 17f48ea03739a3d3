// The state of another run in its file: exact, and refused wherever it is not the scene's.

#include <skein/io/atomic_file.hpp>
#include <skein/io/start_file.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace skein {
namespace {

class StartFile : public testing::Test {
 protected:
  StartFile() {
    scene_.fibers.resize(2);
    for (FiberConfig& fiber : scene_.fibers) fiber.sections = 3, fiber.nodes_per_section = 4;
    for (int i = 0; i < 3 * 24; ++i) position_.push_back(std::sin(i) / 3.0);
    const std::string bytes = encode_start(position_, 0.1 + 0.2);
    scene_.time.start = 0.1 + 0.2;
    scene_.start.checksum = checksum_of_start(bytes);
    write_file_atomically(file(), bytes);
  }

  std::filesystem::path file() const { return find_start(scratch_.path(), scene_.start.checksum); }

  ExitCode read(std::string* message = nullptr) const {
    return code_of([this] { read_start(scratch_.path(), scene_); }, message);
  }

  ScratchFolder scratch_;
  SceneConfig scene_;
  std::vector<double> position_;
};

TEST_F(StartFile, HoldsEveryBit) {
  const auto found = read_start(scratch_.path(), scene_);
  ASSERT_EQ(found.size(), 24u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].x, position_[3 * i]);
    EXPECT_EQ(found[i].y, position_[3 * i + 1]);
    EXPECT_EQ(found[i].z, position_[3 * i + 2]);
  }
}

TEST_F(StartFile, OfAnotherTimeIsRefused) {
  scene_.time.start = 0.3;
  std::string message;
  EXPECT_EQ(read(&message), ExitCode::damaged_data);
  EXPECT_NE(message.find("time.start is 0.3"), std::string::npos) << message;
}

TEST_F(StartFile, OfOtherFibersIsRefused) {
  scene_.fibers[1].sections = 4;
  EXPECT_EQ(read(), ExitCode::damaged_data);
}

TEST_F(StartFile, AWholeFileOfAnotherStateIsRefused) {
  position_[5] = std::nextafter(position_[5], 1.0);
  write_file_atomically(file(), encode_start(position_, scene_.time.start));
  std::string message;
  EXPECT_EQ(read(&message), ExitCode::damaged_data);
  EXPECT_NE(message.find(scene_.start.checksum), std::string::npos) << message;
}

TEST_F(StartFile, OfWhatIsNoNumberIsRefused) {
  position_[7] = std::nan("");
  const std::string bytes = encode_start(position_, scene_.time.start);
  scene_.start.checksum = checksum_of_start(bytes);
  write_file_atomically(file(), bytes);
  EXPECT_EQ(read(), ExitCode::damaged_data);
}

TEST_F(StartFile, ThatIsGoneIsNamed) {
  std::filesystem::remove(file());
  std::string message;
  EXPECT_EQ(read(&message), ExitCode::missing_input);
  EXPECT_NE(message.find(file().filename().string()), std::string::npos) << message;
}

}  // namespace
}  // namespace skein
