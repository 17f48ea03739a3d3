// What `verify` finds, and what a run goes on from.

#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/run_check.hpp>
#include <skein/io/trajectory_end.hpp>
#include <skein/scene/scene_file.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/synthetic_run.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace skein {
namespace {

namespace fs = std::filesystem;

SceneConfig make_scene() {
  SceneConfig scene;
  for (const Fiber& fiber : make_synthetic_layout().fibers) scene.fibers.push_back(fiber.config);
  scene.time.end = 0.25;  // frames of make_synthetic_frame, every 0.05
  return scene;
}

// Step k ends at times[k - 1]; every frame's time is one of them.
StepRecord make_record(const int step, double& time) {
  StepRecord record = make_synthetic_record(step);
  record.time = time + 0.005;
  if (step % 10 == 0) record.time = 0.05 * (step / 10);
  record.dt = record.time - time;
  if (time + record.dt != record.time) record.dt = std::nextafter(record.dt, 1.0);
  time = record.time;
  return record;
}

Checkpoint make_checkpoint(const RunFolder& folder, const TrajectoryEnd& end, const double time) {
  Checkpoint checkpoint;
  checkpoint.set("scene.xxh3", find_trajectory_start(folder).checksum);
  checkpoint.set("state.time", std::vector<double>{time});
  checkpoint.set("state.step", std::vector<std::int64_t>{end.records});
  write_trajectory_end(checkpoint, end);
  return checkpoint;
}

class WholeRun : public testing::Test {
 protected:
  WholeRun() : folder_(RunFolder::create(scratch_.path() / "run", write_scene(make_scene()), false)) {
    const TrajectoryLayout layout = make_synthetic_layout();
    TrajectoryWriter writer(folder_, layout, {}, find_trajectory_start(folder_), never);
    CheckpointFolder checkpoints(folder_);
    double time = 0.0;
    for (int frame = 0; frame <= 5; ++frame) {
      for (int step = 10 * frame - 9; step <= 10 * frame; ++step)
        if (step > 0) writer.append(make_record(step, time));
      Frame written = make_synthetic_frame(layout, frame);
      written.time = frame == 5 ? 0.25 : 0.05 * frame;
      writer.append(written);
      if (frame % 2 == 1) {
        writer.close_segment();
        checkpoints.write(make_checkpoint(folder_, writer.end(), time), 10);
      }
    }
    writer.finish("done");
  }

  std::string problem() const {
    const RunCheck check = check_run(folder_.path());
    return check.problems.empty() ? "" : check.problems.front();
  }

  fs::path segment(const int number) const { return folder_.segments() / fmt_name(number, ".h5"); }
  fs::path checkpoint(const int number) const { return folder_.checkpoints() / fmt_name(number, ".checkpoint"); }

  static std::string fmt_name(const int number, const char* suffix) {
    return "00000" + std::to_string(number) + suffix;
  }

  static void flip_bit(const fs::path& path, const std::size_t at) {
    std::string bytes = read_file(path);
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
    write_file_atomically(path, bytes);
  }

  static void seal_again(const fs::path& path) {
    std::string bytes = read_file(path);
    bytes.resize(bytes.size() - 16);
    write_file_atomically(path, bytes + compute_seal(std::string_view(bytes).substr(0, bytes.size() - 8)));
  }

  ScratchFolder scratch_;
  RunFolder folder_;
};

TEST_F(WholeRun, IsFoundWhole) {
  const RunCheck check = check_run(folder_.path());
  EXPECT_EQ(problem(), "");
  EXPECT_EQ(check.frames, 6);
  EXPECT_EQ(check.records, 50);
  EXPECT_EQ(check.segments, 3);
  EXPECT_EQ(check.checkpoints, 3);
  EXPECT_EQ(check.last_time, 0.25);
  EXPECT_EQ(check.status, "done");
  EXPECT_TRUE(check.notes.empty());
}

TEST_F(WholeRun, AMissingSegmentIsNamed) {
  fs::remove(segment(1));
  EXPECT_NE(problem().find("segments/000001.h5"), std::string::npos);
}

TEST_F(WholeRun, ExchangedSegmentsAreFound) {
  fs::rename(segment(0), segment(9));
  fs::rename(segment(1), segment(0));
  fs::rename(segment(9), segment(1));
  EXPECT_NE(problem().find("segments/000000.h5"), std::string::npos);
}

// The numbers of a frame, step or time: found wherever the file is changed there.
TEST_F(WholeRun, AChangedNumberIsFound) {
  const std::string bytes = read_file(segment(1));
  const double time = 0.05 * 3;
  const std::string pattern(reinterpret_cast<const char*>(&time), sizeof time);
  int n_found = 0;
  for (std::size_t at = bytes.find(pattern); at != std::string::npos; at = bytes.find(pattern, at + 1)) {
    flip_bit(segment(1), at);
    EXPECT_NE(problem().find("segments/000001.h5' was changed"), std::string::npos);
    // Even by somebody who also mends the file's own checksum.
    seal_again(segment(1));
    EXPECT_NE(problem().find("000001.h5' was changed: its contents"), std::string::npos);
    write_file_atomically(segment(1), bytes);
    ++n_found;
  }
  EXPECT_GE(n_found, 2);  // a frame's and a step's
  EXPECT_EQ(problem(), "");
}

TEST_F(WholeRun, AnyChangedByteOfAnyFileIsFound) {
  for (const fs::path& path : {segment(0), segment(2), folder_.index(), checkpoint(1)}) {
    const std::string bytes = read_file(path);
    for (std::size_t at = 3; at < bytes.size(); at += bytes.size() / 12) {
      flip_bit(path, at);
      EXPECT_NE(problem().find(path.filename().string()), std::string::npos) << path << ", byte " << at;
      write_file_atomically(path, bytes);
    }
    fs::resize_file(path, bytes.size() / 2);
    EXPECT_NE(problem().find(path.filename().string()), std::string::npos) << path;
    write_file_atomically(path, bytes);
  }
  EXPECT_EQ(problem(), "");
}

TEST_F(WholeRun, AnotherSceneIsFound) {
  write_file_atomically(folder_.scene(), read_file(folder_.scene()) + "# changed\n");
  EXPECT_NE(problem().find("does not follow"), std::string::npos);
}

TEST_F(WholeRun, ADamagedCheckpointIsNamed) {
  flip_bit(checkpoint(2), 100);
  EXPECT_NE(problem().find("000002.checkpoint"), std::string::npos);
}

TEST_F(WholeRun, GoesOnFromItsNewestGoodCheckpoint) {
  EXPECT_EQ(find_resume_point(folder_).path, checkpoint(3));
  flip_bit(checkpoint(3), 200);
  fs::resize_file(checkpoint(2), 50);
  const ResumePoint point = find_resume_point(folder_);
  EXPECT_EQ(point.path, checkpoint(1));
  ASSERT_EQ(point.rejected.size(), 2u);
  EXPECT_NE(point.rejected[0].find("000003.checkpoint"), std::string::npos);
  EXPECT_NE(point.rejected[1].find("000002.checkpoint"), std::string::npos);
  EXPECT_TRUE(fs::exists(checkpoint(3).string() + ".damaged"));
  EXPECT_EQ(CheckpointFolder::list_numbers(folder_), std::vector<std::int64_t>{1});
}

TEST_F(WholeRun, WithoutAGoodCheckpointIsAnError) {
  for (const int number : {1, 2, 3}) flip_bit(checkpoint(number), 40);
  std::string message;
  EXPECT_EQ(code_of([&] { find_resume_point(folder_); }, &message), ExitCode::damaged_data);
  for (const char* name : {"000001", "000002", "000003"}) EXPECT_NE(message.find(name), std::string::npos);
}

TEST_F(WholeRun, WithoutAnyCheckpointStartsAgain) {
  fs::remove_all(folder_.checkpoints());
  EXPECT_FALSE(find_resume_point(folder_).checkpoint);
}

TEST_F(WholeRun, ACheckpointWhoseFramesAreGoneCannotServe) {
  fs::remove(segment(2));
  const ResumePoint point = find_resume_point(folder_);
  EXPECT_EQ(point.path, checkpoint(2));
  EXPECT_NE(point.rejected.at(0).find("segments/000002.h5"), std::string::npos);
}

TEST_F(WholeRun, IsCutAtTheCheckpointAndWrittenAgain) {
  const std::string certificate = check_run(folder_.path()).checksum;
  const TrajectoryLayout layout = make_synthetic_layout();
  const TrajectoryEnd end = read_trajectory_end(*find_resume_point(folder_).checkpoint);
  EXPECT_EQ(end.segments, 3);
  const TrajectoryEnd second = read_trajectory_end(read_checkpoint(checkpoint(2)));
  write_file_atomically(folder_.segments() / "000002.h5.partial", "half");
  {
    TrajectoryWriter writer(folder_, layout, {}, second, never);
    EXPECT_EQ(writer.end().checksum, second.checksum);
    EXPECT_EQ(names_in(folder_.segments()), (std::set<std::string>{"000000.h5", "000001.h5"}));
    EXPECT_EQ(check_run(folder_.path()).frames, 4);
    // Moments that are there already are refused.
    EXPECT_EQ(code_of([&] { writer.append(make_synthetic_frame(layout, 3)); }), ExitCode::internal);
    double time = 0.05 * 3;
    for (int frame = 4; frame <= 5; ++frame) {
      for (int step = 10 * frame - 9; step <= 10 * frame; ++step) writer.append(make_record(step, time));
      Frame written = make_synthetic_frame(layout, frame);
      written.time = frame == 5 ? 0.25 : 0.05 * frame;
      writer.append(written);
    }
    writer.finish("done");
  }
  EXPECT_EQ(problem(), "");
  EXPECT_EQ(check_run(folder_.path()).checksum, certificate);
}

TEST_F(WholeRun, KeepsTheNewestCheckpoints) {
  CheckpointFolder checkpoints(folder_);
  EXPECT_EQ(checkpoints.last_number(), 3);
  checkpoints.write(read_checkpoint(checkpoint(3)), 2);
  EXPECT_EQ(CheckpointFolder::list_numbers(folder_), (std::vector<std::int64_t>{3, 4}));
}

}  // namespace
}  // namespace skein
