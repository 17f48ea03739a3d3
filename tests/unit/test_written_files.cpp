// What may stand where a file is going to be written: links to precious files, pipes, devices, folders.
#include <skein/core/error.hpp>
#include <skein/io/array_file.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/line_file.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_lock.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>
#include <string>

namespace skein {
namespace {

namespace fs = std::filesystem;

/// A folder with a precious file, to which everything that is planted leads.
class Planted {
 public:
  Planted() { write_file_atomically(victim(), "precious"); }

  fs::path victim() const { return scratch_.path() / "victim"; }
  fs::path place(const std::string& name) const { return scratch_.path() / name; }
  bool victim_is_whole() const { return read_file(victim()) == "precious"; }

  void plant_link(const fs::path& path) const { fs::create_symlink(victim(), path); }
  static void plant_pipe(const fs::path& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); }

 private:
  ScratchFolder scratch_;
};

TEST(WrittenFiles, AtomicFilesTakeTheNameOfWhatStandsThere) {
  const Planted planted;
  const fs::path path = planted.place("file"), partial = planted.place("file.partial");
  const std::function<void()> plants[] = {
      [&] { planted.plant_link(partial); },
      [&] { Planted::plant_pipe(partial); },
      [&] { fs::create_symlink(planted.place("nowhere"), partial); },
      [&] { fs::create_symlink("/dev/full", partial); },
      [&] { fs::create_hard_link(planted.victim(), partial); },
      [&] { write_file_atomically(partial, "left by a kill, and longer than what comes"); },
      [&] { planted.plant_link(path); },
      [&] { Planted::plant_pipe(path); },
      [&] { fs::create_hard_link(planted.victim(), path); },
  };
  for (const auto& plant : plants) {
    fs::remove(path);
    plant();
    write_file_atomically(path, "new");
    EXPECT_TRUE(planted.victim_is_whole());
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path)));
    EXPECT_EQ(read_file(path), "new");
    EXPECT_FALSE(fs::exists(fs::symlink_status(partial)));
    EXPECT_FALSE(fs::exists(planted.place("nowhere")));
  }
}

TEST(WrittenFiles, AFolderInTheWayIsNamed) {
  const Planted planted;
  fs::create_directory(planted.place("file.partial"));
  std::string message;
  EXPECT_EQ(code_of([&] { write_file_atomically(planted.place("file"), "new"); }, &message), ExitCode::cannot_create);
  EXPECT_NE(message.find("is a folder"), std::string::npos) << message;
}

// HDF5 looks for a file of the name that it is given, even for one that it makes in memory.
TEST(WrittenFiles, ArrayFilesOpenNothingThatStandsThere) {
  const Planted planted;
  const fs::path path = planted.place("tables.h5");
  for (const auto& plant :
       {std::function([&] { planted.plant_link(path); }), std::function([&] { Planted::plant_pipe(path); })}) {
    fs::remove(path);
    plant();
    write_array_file(path, {{"time", "time", {2}, {0.0, 1.0}}}, {});
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path)));
    EXPECT_TRUE(planted.victim_is_whole());
  }
}

TEST(WrittenFiles, LogsAndLocksRefuseWhatIsNoFile) {
  const Planted planted;
  const RunFolder folder = RunFolder::create(planted.place("run"), "", false);
  const std::pair<const char*, std::function<void(const fs::path&)>> plants[] = {
      {"a symbolic link", [&](const fs::path& path) { planted.plant_link(path); }},
      {"a symbolic link", [&](const fs::path& path) { fs::create_symlink(planted.place("nowhere"), path); }},
      {"a pipe", [](const fs::path& path) { Planted::plant_pipe(path); }},
      {"a folder", [](const fs::path& path) { fs::create_directory(path); }},
      {"a symbolic link", [](const fs::path& path) { fs::create_symlink("/dev/null", path); }},
  };
  for (const auto& [kind, plant] : plants) {
    for (const fs::path& path : {folder.run_log(), folder.lock()}) {
      plant(path);
      std::string message;
      const auto open = [&] { path == folder.lock() ? void(RunLock(folder)) : LineFile(path).write_line("spoilt"); };
      EXPECT_EQ(code_of(open, &message), ExitCode::cannot_create) << path;
      EXPECT_NE(message.find(kind), std::string::npos) << message;
      EXPECT_NE(message.find(path.string()), std::string::npos) << message;
      fs::remove(path);
    }
  }
  EXPECT_TRUE(planted.victim_is_whole());
  EXPECT_FALSE(fs::exists(planted.place("nowhere")));
}

// Snapshots share files by hard links: what is written in one must not be seen in the other.
TEST(WrittenFiles, OtherNamesOfLogsAndLocksKeepTheirContent) {
  const Planted planted;
  const RunFolder folder = RunFolder::create(planted.place("run"), "", false);
  fs::create_hard_link(planted.victim(), folder.run_log());
  fs::create_hard_link(planted.victim(), folder.lock());
  LineFile(folder.run_log()).write_line("+");
  EXPECT_EQ(read_file(folder.run_log()), "precious+\n");
  const RunLock lock(folder);
  EXPECT_NE(read_file(folder.lock()), "precious");
  EXPECT_EQ(code_of([&] { RunLock second(folder); }), ExitCode::cannot_create);
  EXPECT_TRUE(planted.victim_is_whole());
}

}  // namespace
}  // namespace skein
