// What `verify` finds, and what a run goes on from.

#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/listed_segments.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_check.hpp>
#include <skein/io/run_leftovers.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_end.hpp>
#include <skein/scene/earlier_ends.hpp>
#include <skein/scene/scene_file.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/synthetic_run.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace skein {
namespace {

namespace fs = std::filesystem;

SceneConfig make_scene() {
  SceneConfig scene;
  for (const Fiber& fiber : make_synthetic_layout().fibers) scene.fibers.push_back(fiber.config);
  scene.time.end = 0.25;
  scene.output.frame_interval = 0.05;  // of make_synthetic_frame
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
    const TrajectoryLayout layout = make_synthetic_layout(read_file(folder_.scene()));
    TrajectoryWriter writer(folder_, layout, {}, find_trajectory_start(folder_), never);
    writer.begin();
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

// By somebody who also mends the file's own checksum.
TEST_F(WholeRun, AnIndexThatListsAnotherChainIsNamed) {
  const std::string checksum = check_run(folder_.path()).checksum;
  std::string bytes = read_file(folder_.index());
  int n_found = 0;
  for (std::size_t at = bytes.find(checksum); at != std::string::npos; at = bytes.find(checksum, at + 1), ++n_found)
    bytes[at] = bytes[at] == '0' ? '1' : '0';
  ASSERT_GE(n_found, 1);
  write_file_atomically(folder_.index(), bytes);
  seal_again(folder_.index());
  EXPECT_NE(problem().find("'trajectory.h5' says that the chain"), std::string::npos) << problem();
}

TEST_F(WholeRun, AnotherSceneIsFound) {
  write_file_atomically(folder_.scene(), read_file(folder_.scene()) + "# changed\n");
  EXPECT_NE(problem().find("was changed since"), std::string::npos);
  std::string message;
  EXPECT_EQ(code_of([&] { read_run_summary(folder_.path()); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find(folder_.scene().string()), std::string::npos) << message;
  EXPECT_EQ(code_of([&] { find_resume_point(folder_, false); }), ExitCode::damaged_data);
  // Also where the index cannot tell, and nothing is renamed.
  fs::remove(folder_.index());
  EXPECT_NE(problem().find("is gone"), std::string::npos);
  EXPECT_EQ(code_of([&] { find_resume_point(folder_, false); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find("another scene"), std::string::npos) << message;
  EXPECT_EQ(CheckpointFolder::list_numbers(folder_), (std::vector<std::int64_t>{1, 2, 3}));
}

TEST_F(WholeRun, WhoseEndWasMovedIsStillItself) {
  const std::string first = read_file(folder_.scene()), later = prolong_scene_text(first, 0.3);
  write_file_atomically(folder_.scene(), later);
  const RunCheck check = check_run(folder_.path());
  EXPECT_TRUE(check.problems.empty()) << check.problems.front();
  ASSERT_EQ(check.notes.size(), 1u);
  EXPECT_NE(check.notes[0].find("its end was moved to 0.3"), std::string::npos) << check.notes[0];
  EXPECT_EQ(read_run_summary(folder_.path()).certificate, check.checksum);
  EXPECT_EQ(find_resume_point(folder_, false).path, checkpoint(3));
  // Only by what resume writes.
  for (const char* list : {"earlier_ends = [0.2]", "earlier_ends = [0.25, 0.26]"}) {
    std::string edited = later;
    edited.replace(edited.find("earlier_ends = [0.25]"), 21, list);
    write_file_atomically(folder_.scene(), edited);
    EXPECT_EQ(problem().empty(), std::string(list).find("0.25") != std::string::npos) << problem();
  }
}

TEST_F(WholeRun, ReadersRenameNothing) {
  flip_bit(checkpoint(3), 200);
  const ResumePoint point = look_for_resume_point(folder_);
  EXPECT_EQ(point.path, checkpoint(2));
  ASSERT_EQ(point.rejected.size(), 1u);
  EXPECT_TRUE(fs::exists(checkpoint(3)));
}

TEST_F(WholeRun, IsCheckedWithoutItsIndex) {
  fs::remove(folder_.index());
  const RunCheck check = check_run(folder_.path());
  ASSERT_EQ(check.problems.size(), 1u);
  EXPECT_NE(check.problems[0].find("trajectory.h5"), std::string::npos);
  EXPECT_EQ(check.frames, 6);
  EXPECT_EQ(check.segments, 3);
}

TEST_F(WholeRun, ADamagedCheckpointIsNamed) {
  flip_bit(checkpoint(2), 100);
  EXPECT_NE(problem().find("000002.checkpoint"), std::string::npos);
}

TEST_F(WholeRun, GoesOnFromItsNewestGoodCheckpoint) {
  EXPECT_EQ(find_resume_point(folder_, false).path, checkpoint(3));
  flip_bit(checkpoint(3), 200);
  fs::resize_file(checkpoint(2), 50);
  const ResumePoint point = find_resume_point(folder_, false);
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
  EXPECT_EQ(code_of([&] { find_resume_point(folder_, false); }, &message), ExitCode::damaged_data);
  for (const char* name : {"000001", "000002", "000003"}) EXPECT_NE(message.find(name), std::string::npos);
}

// Frames are dropped only on request, whatever became of the checkpoints.
TEST_F(WholeRun, WithoutAnyCheckpointStartsAgainOnlyOnRequest) {
  fs::remove_all(folder_.checkpoints());
  std::string message;
  EXPECT_EQ(code_of([&] { find_resume_point(folder_, false); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find("--from-start"), std::string::npos) << message;
  EXPECT_EQ(problem(), "");  // it is done, and its frames are whole
  EXPECT_NE(check_run(folder_.path()).notes.at(0).find("no checkpoint"), std::string::npos);
  EXPECT_FALSE(find_resume_point(folder_, true).checkpoint);
}

TEST_F(WholeRun, WithAGoodCheckpointDoesNotStartAgain) {
  EXPECT_EQ(code_of([&] { find_resume_point(folder_, true); }), ExitCode::usage);
}

TEST_F(WholeRun, WithoutFramesStartsByItself) {
  fs::remove_all(folder_.checkpoints());
  fs::remove_all(folder_.segments());
  EXPECT_FALSE(find_resume_point(folder_, false).checkpoint);
}

TEST_F(WholeRun, WhoseCheckpointsCannotBeListedIsLeftAsItIs) {
  const fs::path elsewhere = scratch_.path() / "elsewhere";
  fs::rename(folder_.checkpoints(), elsewhere);
  const auto check = [&] {
    for (const bool from_start : {false, true}) {
      std::string message;
      EXPECT_EQ(code_of([&] { find_resume_point(folder_, from_start); }, &message), ExitCode::io_error);
      EXPECT_NE(message.find(folder_.checkpoints().string()), std::string::npos) << message;
    }
    const RunCheck found = check_run(folder_.path());
    ASSERT_EQ(found.problems.size(), 1u);
    EXPECT_NE(found.problems[0].find(folder_.checkpoints().string()), std::string::npos);
    EXPECT_EQ(found.unreadable, 1);
    EXPECT_EQ(found.frames, 6);
    fs::remove(folder_.checkpoints());
  };
  fs::create_symlink("/not/mounted", folder_.checkpoints());
  check();
  write_file_atomically(folder_.checkpoints(), "a file");
  check();
  ASSERT_EQ(::mkfifo(folder_.checkpoints().c_str(), 0600), 0);
  check();
  fs::rename(elsewhere, folder_.checkpoints());
  EXPECT_EQ(problem(), "");
}

TEST_F(WholeRun, GoesOnFromAnOlderCheckpointWhereTheNewestIsNoFile) {
  fs::remove(checkpoint(3));
  fs::create_directory(checkpoint(3));
  EXPECT_NE(problem().find("it is a folder"), std::string::npos) << problem();
  EXPECT_EQ(find_resume_point(folder_, false).path, checkpoint(2));
  ASSERT_EQ(::mkfifo(checkpoint(3).c_str(), 0600), 0);
  const ResumePoint point = find_resume_point(folder_, false);
  EXPECT_EQ(point.path, checkpoint(2));
  EXPECT_NE(point.rejected.at(0).find("it is a pipe"), std::string::npos) << point.rejected.at(0);
}

TEST_F(WholeRun, WhoseCheckpointsCannotBeReadIsAnErrorOfReading) {
  for (const int number : {1, 2, 3}) {
    fs::remove(checkpoint(number));
    fs::create_directory(checkpoint(number));
  }
  EXPECT_EQ(code_of([&] { find_resume_point(folder_, false); }), ExitCode::io_error);
  EXPECT_EQ(check_run(folder_.path()).unreadable, 3);
}

TEST_F(WholeRun, ASegmentOfAnotherPlaceIsNotTakenForTheOneThatIsListed) {
  EXPECT_NO_THROW(check_listed_segments(folder_));
  fs::copy_file(segment(1), segment(2), fs::copy_options::overwrite_existing);
  std::string message;
  EXPECT_EQ(code_of([&] { check_listed_segments(folder_); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find("segments/000002.h5"), std::string::npos) << message;
  fs::remove(segment(2));
  ASSERT_EQ(::mkfifo(segment(2).c_str(), 0600), 0);
  EXPECT_EQ(code_of([&] { check_listed_segments(folder_); }, &message), ExitCode::io_error);
  EXPECT_NE(message.find("segments/000002.h5"), std::string::npos) << message;
}

TEST_F(WholeRun, OnlyFilesOfTheRunAreTakenForItsLeftovers) {
  for (const fs::path& path : {folder_.path() / "mine.partial", folder_.segments() / "notes.h5"})
    write_file_atomically(path, "mine");
  write_file_atomically(segment(7), "behind the end");
  write_file_atomically(folder_.path() / "trajectory.h5.partial", "half");
  remove_leftovers(folder_, 3);
  EXPECT_TRUE(fs::exists(folder_.path() / "mine.partial"));
  EXPECT_TRUE(fs::exists(folder_.segments() / "notes.h5"));
  EXPECT_FALSE(fs::exists(segment(7)));
  EXPECT_FALSE(fs::exists(folder_.path() / "trajectory.h5.partial"));
  EXPECT_EQ(problem(), "");
}

TEST_F(WholeRun, ACheckpointWhoseFramesAreGoneCannotServe) {
  fs::remove(segment(2));
  const ResumePoint point = find_resume_point(folder_, false);
  EXPECT_EQ(point.path, checkpoint(2));
  EXPECT_NE(point.rejected.at(0).find("segments/000002.h5"), std::string::npos);
}

TEST_F(WholeRun, IsCutAtTheCheckpointAndWrittenAgain) {
  const std::string certificate = check_run(folder_.path()).checksum;
  const TrajectoryLayout layout = make_synthetic_layout(read_file(folder_.scene()));
  const TrajectoryEnd end = read_trajectory_end(*find_resume_point(folder_, false).checkpoint);
  EXPECT_EQ(end.segments, 3);
  const TrajectoryEnd second = read_trajectory_end(read_checkpoint(checkpoint(2)));
  write_file_atomically(folder_.segments() / "000002.h5.partial", "half");
  {
    TrajectoryWriter writer(folder_, layout, {}, second, never);
    EXPECT_EQ(check_run(folder_.path()).frames, 6) << "nothing is removed before the run begins";
    writer.begin();
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
