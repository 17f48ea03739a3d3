#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/start_file.hpp>
#include <skein/io/trajectory_writer.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/file_size_limit.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/synthetic_run.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, RefusesWhatItWouldDestroy) {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run";
  write_three_segments(RunFolder::create(run, "scene", false), {});
  EXPECT_EQ(code_of([&] { RunFolder::create(run, "scene", false); }), ExitCode::cannot_create);
  EXPECT_EQ(read_run_summary(run).frames, 5);

  const fs::path own = scratch.path() / "own";
  fs::create_directory(own);
  write_file_atomically(own / "scene.toml", "mine");
  std::string message;
  EXPECT_EQ(code_of([&] { RunFolder::create(own, "scene", true); }, &message), ExitCode::cannot_create);
  EXPECT_NE(message.find(own.string()), std::string::npos) << message;
  EXPECT_EQ(read_file(own / "scene.toml"), "mine");
  EXPECT_EQ(code_of([&] { RunFolder::create(own / "scene.toml", "scene", true); }), ExitCode::cannot_create);
  EXPECT_EQ(code_of([&] { RunFolder::create(own / "scene.toml" / "run", "scene", true); }), ExitCode::cannot_create);
}

TEST(RunFolder, OverwritesOnlyWhatARunWrote) {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run";
  write_three_segments(RunFolder::create(run, "scene", false), {});
  write_file_atomically(run / "notes.txt", "mine");
  write_file_atomically(run / "segments" / "notes.h5", "mine");
  write_file_atomically(run / "segments" / "000009.h5.partial", "left by a kill");
  RunFolder::create(run, "new scene", true);

  EXPECT_EQ(names_in(run), (std::set<std::string>{"notes.txt", "scene.toml", "segments"}));
  EXPECT_EQ(names_in(run / "segments"), (std::set<std::string>{"notes.h5"}));
  EXPECT_EQ(read_file(run / "scene.toml"), "new scene");
}

TEST(RunFolder, TablesAndPicturesGoWithTheRunThatTheyShow) {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run";
  const RunFolder folder = RunFolder::create(run, "scene", false);
  for (const fs::path& results : {folder.analysis(), folder.plots()}) fs::create_directory(results);
  for (const char* name : {"diagnostics.h5", "diagnostics.csv", "diagnostics.h5.partial"})
    write_file_atomically(folder.analysis() / name, "old");
  for (const char* name : {"shapes.png", "defects.svg", "movie.mp4", "angle.pdf.partial", "shapes.txt", "mine.png"})
    write_file_atomically(folder.plots() / name, "old");
  RunFolder::create(run, "new scene", true);
  EXPECT_EQ(names_in(run), (std::set<std::string>{"plots", "scene.toml", "segments"}));
  EXPECT_EQ(names_in(folder.plots()), (std::set<std::string>{"mine.png", "shapes.txt"}));

  // Another folder that a link leads to is not this run's.
  fs::create_directory(scratch.path() / "elsewhere");
  write_file_atomically(scratch.path() / "elsewhere" / "diagnostics.h5", "another's");
  fs::create_symlink(scratch.path() / "elsewhere", folder.analysis());
  RunFolder::create(run, "new scene", true);
  EXPECT_EQ(read_file(scratch.path() / "elsewhere" / "diagnostics.h5"), "another's");
}

TEST(RunFolder, KnowsItsPartsByEveryName) {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run", link = scratch.path() / "link";
  const RunFolder folder = RunFolder::create(run, "scene", false);
  fs::create_directory_symlink(run, link);
  fs::create_symlink(folder.scene(), scratch.path() / "mine.toml");
  fs::create_directory_symlink(folder.segments(), scratch.path() / "s");
  const fs::path parts[] = {"run/trajectory.h5",
                            "link/trajectory.h5",
                            "run/../run/./segments/../scene.toml",
                            "run/segments/000000.h5",
                            "run/segments",
                            "run/segments/",
                            "link/checkpoints/new.h5",
                            "run/lock",
                            "run/trajectory.h5.partial",
                            "mine.toml",
                            "s/flow.vti",
                            "s",
                            "run/STOP",
                            "link//run.log"};
  for (const fs::path& part : parts) EXPECT_TRUE(folder.is_part(scratch.path() / part)) << part;
  const fs::path others[] = {"run/flow.vti", "run/plots/shapes.png", "run/analysis",      "trajectory.h5", "run",
                             "link/",        "other/segments/x",     "run/../scene.toml", "run/notes/lock"};
  for (const fs::path& other : others) EXPECT_FALSE(folder.is_part(scratch.path() / other)) << other;

  const fs::path before = fs::current_path();
  fs::current_path(run);
  EXPECT_TRUE(folder.is_part("trajectory.h5"));
  EXPECT_TRUE(folder.is_part("./segments"));
  EXPECT_FALSE(folder.is_part("flow.vti"));
  fs::current_path(before);
}

TEST(RunFolder, HasAName) {
  EXPECT_EQ(code_of([] { RunFolder::create("", "scene", false); }), ExitCode::usage);
}

TEST(RunFolder, TakesOverWhatARunLeftThatWasKilledBeforeItsScene) {
  const ScratchFolder scratch;
  const std::string scene = "title = \"mine\"\n[time]\n";
  int n = 0;
  for (const char* half : {"", "ti", "title = \"mi"}) {
    const fs::path run = scratch.path() / std::to_string(n++);
    fs::create_directories(run / "segments");
    write_file_atomically(run / "scene.toml.partial", half);
    RunFolder::create(run, scene, false);
    EXPECT_EQ(names_in(run), (std::set<std::string>{"scene.toml", "segments"}));
    EXPECT_EQ(read_file(run / "scene.toml"), scene);
  }
  for (const char* name : {"start-0123456789abcdef.checkpoint", "start-0123456789abcdef.checkpoint.partial"}) {
    const fs::path run = scratch.path() / std::to_string(n++);
    fs::create_directories(run / "segments");
    write_file_atomically(run / name, checkpoint_magic.substr(0, 5));
    RunFolder::create(run, scene, false);
    EXPECT_EQ(names_in(run), (std::set<std::string>{"scene.toml", "segments"})) << name;
  }
  const fs::path bare = scratch.path() / "bare";
  fs::create_directories(bare / "segments");
  RunFolder::create(bare, scene, false);
}

TEST(RunFolder, TakesNothingElseForSuchRemains) {
  const ScratchFolder scratch;
  const std::string scene = "title = \"mine\"\n[time]\n";
  const auto refuses = [&](const fs::path& path, const char* content) {
    const fs::path run = scratch.path() / "run";
    fs::create_directories(run / "segments");
    if (content == nullptr)
      fs::create_directories(run / path);
    else
      write_file_atomically(run / path, content);
    EXPECT_EQ(code_of([&] { RunFolder::create(run, scene, false); }), ExitCode::cannot_create) << path;
    EXPECT_TRUE(fs::exists(run / path)) << path;
    fs::remove_all(run);
  };
  refuses("notes.txt", "mine");
  refuses("scene.toml", "mine");
  refuses("segments/000000.h5", "frames");
  refuses("scene.toml.partial", "somebody's own");
  refuses("scene.toml.partial", nullptr);
  refuses("start-0123456789abcdef.checkpoint", "somebody's own");
  const std::string magic(checkpoint_magic);
  for (const char* name : {"start-.checkpoint", "start-0123456789abcdeF.checkpoint", "start-0123456789abcde.checkpoint",
                           "start-checkpoint", "start-0123456789abcdef"})
    refuses(name, magic.c_str());
  refuses("checkpoints", nullptr);
  // Nor a folder of segments that is elsewhere.
  const fs::path linked = scratch.path() / "linked";
  fs::create_directories(linked);
  fs::create_directories(scratch.path() / "elsewhere");
  fs::create_directory_symlink(scratch.path() / "elsewhere", linked / "segments");
  EXPECT_EQ(code_of([&] { RunFolder::create(linked, scene, false); }), ExitCode::cannot_create);
}

TEST(RunFolder, HasTheStateThatItBeginsWith) {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run";
  const RunFolder folder = RunFolder::create(run, "scene", false, {}, "a state");
  const fs::path start = find_start(run, checksum_of_start("a state"));
  EXPECT_EQ(read_file(start), "a state");
  EXPECT_TRUE(folder.is_part(start));
  RunFolder::create(run, "another", true, {}, "another state");
  EXPECT_EQ(read_file(find_start(run, checksum_of_start("another state"))), "another state");
  EXPECT_FALSE(fs::exists(start));
  RunFolder::create(run, "the same state", true, {}, "another state");
  EXPECT_EQ(read_file(find_start(run, checksum_of_start("another state"))), "another state");
  RunFolder::create(run, "without", true);
  EXPECT_EQ(names_in(run), (std::set<std::string>{"scene.toml", "segments"}));
}

TEST(RunFolder, KeepsTheEarlierRunWhereTheNewOneCannotBegin) {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run";
  write_three_segments(RunFolder::create(run, "scene", false), {});
  const FileSizeLimit limit(1000);
  EXPECT_EQ(code_of([&] { RunFolder::create(run, std::string(5000, 'x'), true); }), ExitCode::io_error);
  EXPECT_EQ(read_run_summary(run).frames, 5);
  // Nor is anything removed that was not seen whole.
  fs::create_symlink("/not/mounted", run / "checkpoints");
  EXPECT_EQ(code_of([&] { RunFolder::create(run, "new", true); }), ExitCode::io_error);
  EXPECT_EQ(read_run_summary(run).frames, 5);
  // Whoever locks the folder does so before.
  EXPECT_EQ(code_of([&] {
              RunFolder::create(run, "new", true, [](const RunFolder&) { throw Error(ExitCode::usage, "in use"); });
            }),
            ExitCode::usage);
  EXPECT_EQ(read_run_summary(run).frames, 5);
}

TEST(ReadFile, ReadsFilesAndNothingElse) {
  const ScratchFolder scratch;
  std::string message;
  EXPECT_EQ(code_of([&] { read_file(scratch.path() / "nowhere"); }), ExitCode::missing_input);
  EXPECT_EQ(code_of([&] { read_file(scratch.path()); }, &message), ExitCode::io_error);
  EXPECT_NE(message.find(scratch.path().string() + "': it is a folder"), std::string::npos) << message;
  const fs::path pipe = scratch.path() / "pipe", link = scratch.path() / "link", file = scratch.path() / "file";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(code_of([&] { read_file(pipe); }, &message), ExitCode::io_error);  // without waiting for a writer
  EXPECT_NE(message.find("it is a pipe"), std::string::npos) << message;
  EXPECT_EQ(code_of([&] { check_is_file(pipe); }), ExitCode::io_error);
  fs::create_symlink(link, link);
  EXPECT_EQ(code_of([&] { read_file(link); }), ExitCode::io_error);
  EXPECT_EQ(code_of([&] { read_file("/dev/zero"); }), ExitCode::io_error);
  const std::string content(200'001, 'x');
  write_file_atomically(file, content);
  EXPECT_EQ(read_file(file), content);
  fs::resize_file(file, 0);
  EXPECT_EQ(read_file(file), "");
  EXPECT_FALSE(read_file("/proc/self/stat").empty());
  // The system says EIO where a process's memory is read that is not there.
  EXPECT_EQ(code_of([&] { read_file("/proc/self/mem"); }, &message), ExitCode::io_error);
  EXPECT_NE(message.find("Input/output error"), std::string::npos) << message;
}

TEST(FolderListing, TellsNothingThereFromNotSeen) {
  const ScratchFolder scratch;
  const fs::path link = scratch.path() / "link", file = scratch.path() / "file";
  EXPECT_TRUE(list_names(scratch.path() / "nowhere").empty());
  EXPECT_FALSE(is_there(scratch.path() / "nowhere"));
  fs::create_symlink("/not/mounted", link);
  EXPECT_TRUE(is_there(link));
  EXPECT_EQ(code_of([&] { list_names(link); }), ExitCode::io_error);
  write_file_atomically(file, "");
  EXPECT_EQ(code_of([&] { list_names(file); }), ExitCode::io_error);
  EXPECT_EQ(list_names(scratch.path()), (std::vector<std::string>{"file", "link"}));
  EXPECT_EQ(code_of([&] { is_there(scratch.path() / std::string(300, 'x')); }), ExitCode::io_error);
}

TEST(RunSummary, CountsWhatIsThere) {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run";
  write_three_segments(RunFolder::create(run, "scene", false), {});

  const RunSummary summary = read_run_summary(run);
  EXPECT_EQ(summary.title, "two synthetic tubes");
  EXPECT_EQ(summary.status, "done");
  EXPECT_EQ(summary.frames, 5);
  EXPECT_EQ(summary.steps, 40);
  EXPECT_EQ(summary.segments, 3);
  EXPECT_EQ(summary.last_time, 0.05 * 4);
}

TEST(RunSummary, ReadsARunThatHasNotWrittenAFrame) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  const TrajectoryWriter writer(folder, make_synthetic_layout(), {});

  const RunSummary summary = read_run_summary(folder.path());
  EXPECT_EQ(summary.status, "running");
  EXPECT_EQ(summary.frames, 0);
  EXPECT_TRUE(std::isnan(summary.last_time));
}

TEST(RunSummary, NamesTheFileThatIsMissingOrDamaged) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  EXPECT_EQ(code_of([&] { read_run_summary(scratch.path() / "nowhere"); }), ExitCode::missing_input);
  EXPECT_EQ(code_of([&] { read_run_summary(folder.path()); }), ExitCode::missing_input);  // no index yet

  write_three_segments(folder, {});
  fs::rename(folder.segments() / "000001.h5", scratch.path() / "000001.h5");
  std::string message;
  EXPECT_EQ(code_of([&] { read_run_summary(folder.path()); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find("000001.h5"), std::string::npos) << message;

  for (const std::uintmax_t size : {0, 7, 100, 3000}) {
    fs::resize_file(folder.index(), size);
    EXPECT_EQ(code_of([&] { read_run_summary(folder.path()); }, &message), ExitCode::damaged_data) << size;
    EXPECT_NE(message.find("trajectory.h5"), std::string::npos) << message;
  }
}

TEST(AtomicFile, LeavesTheOldFileWhenTheDiskIsFull) {
  const ScratchFolder scratch;
  const fs::path path = scratch.path() / "file";
  write_file_atomically(path, "old");
  std::string message;
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(code_of([&] { write_file_atomically(path, std::string(5000, 'x')); }, &message), ExitCode::io_error);
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(names_in(scratch.path()), std::set<std::string>{"file"});
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
  EXPECT_NE(message.find("5000 bytes"), std::string::npos) << message;
  EXPECT_NE(message.find("only 1000"), std::string::npos) << message;
}

}  // namespace
}  // namespace skein
