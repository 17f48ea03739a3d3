#include <skein/core/error.hpp>
#include <skein/io/event_log.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_log.hpp>

#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>
#include <string>
#include <vector>

namespace skein {
namespace {

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::vector<std::string> lines(1);
  for (const char c : read_file(path)) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  }
  EXPECT_EQ(lines.back(), "") << "the last line is not closed";
  lines.pop_back();
  return lines;
}

TEST(RunLog, GivesEveryLineItsWallTime) {
  const ScratchFolder scratch;
  RunLog log(scratch.path() / "run.log");
  log.write("first\nsecond\n");
  log.write("third");

  const auto lines = lines_of(scratch.path() / "run.log");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_NE(lines[0].find("UTC"), std::string::npos);
  for (const std::string& line : lines) EXPECT_NE(line.find(" s  "), std::string::npos) << line;
  EXPECT_EQ(lines[1].substr(lines[1].size() - 5), "first");
  EXPECT_EQ(lines[2].substr(lines[2].size() - 6), "second");
}

TEST(EventLog, WritesOneObjectALineAtOnce) {
  const ScratchFolder scratch;
  EventLog log(scratch.path() / "events.jsonl");
  log.write("start", {{"method", "rkc2"}, {"nodes", std::int64_t{1440}}, {"resumed", false}});
  log.write("a \"name\"\n", {{"dt", 0.1}, {"gap", std::numeric_limits<double>::infinity()}});

  const auto lines = lines_of(scratch.path() / "events.jsonl");  // while the log is open
  ASSERT_EQ(lines.size(), 2u);
  const auto ends_with = [](const std::string& line, const std::string& end) {
    return line.size() >= end.size() && line.substr(line.size() - end.size()) == end;
  };
  EXPECT_EQ(lines[0].rfind("{\"event\": \"start\", \"wall\": ", 0), 0u) << lines[0];
  EXPECT_TRUE(ends_with(lines[0], ", \"method\": \"rkc2\", \"nodes\": 1440, \"resumed\": false}")) << lines[0];
  EXPECT_EQ(lines[1].rfind("{\"event\": \"a \\\"name\\\"\\u000a\", ", 0), 0u) << lines[1];
  EXPECT_TRUE(ends_with(lines[1], ", \"dt\": 0.1, \"gap\": null}")) << lines[1];
}

TEST(EventLog, StaysJsonForAFileNamedInLatin1) {
  const ScratchFolder scratch;
  EventLog log(scratch.path() / "events.jsonl");
  log.write("failed", {{"message", std::string("cannot write 'r\xe9sultat/trajectory.h5'")}});

  const auto lines = lines_of(scratch.path() / "events.jsonl");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find(R"("message": "cannot write 'r\ufffdsultat/trajectory.h5'"})"), std::string::npos)
      << lines[0];
}

/// No file of this process grows above so many bytes; who tries is told as by a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(const rlim_t n_bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &usual_);
    const rlimit small{n_bytes, usual_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &usual_);
    std::signal(SIGXFSZ, before_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*before_)(int);
  rlimit usual_{};
};

TEST(LineFile, ContinuesAnExistingFileAndReportsAFullDisk) {
  const ScratchFolder scratch;
  { LineFile(scratch.path() / "log").write_line("one"); }
  { LineFile(scratch.path() / "log").write_line("two"); }
  EXPECT_EQ(read_file(scratch.path() / "log"), "one\ntwo\n");

  const FileSizeLimit full(8);
  try {
    LineFile(scratch.path() / "log").write_line("three");
    FAIL() << "a write past the largest size of files passed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io_error);
    EXPECT_NE(std::string(error.what()).find("6 bytes to '"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace skein
