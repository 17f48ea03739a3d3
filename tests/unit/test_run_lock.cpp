#include <skein/io/atomic_file.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_lock.hpp>

#include "src/io/local_file_system.hpp"
#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

namespace skein {
namespace {

RunFolder make_folder(const ScratchFolder& scratch) { return RunFolder::create(scratch.path() / "run", "", false); }

// A process that takes the lock and keeps it until it is killed.
pid_t start_owner(const RunFolder& folder) {
  int ready[2];
  if (::pipe(ready) != 0) return -1;
  const pid_t process = ::fork();
  if (process == 0) {
    const RunLock lock(folder);
    static_cast<void>(!::write(ready[1], "x", 1));
    for (;;) ::pause();
  }
  char byte = 0;
  static_cast<void>(!::read(ready[0], &byte, 1));
  ::close(ready[0]);
  ::close(ready[1]);
  return process;
}

void kill_owner(const pid_t process) {
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
}

TEST(RunLock, KeepsASecondWriterOut) {
  const ScratchFolder scratch;
  const RunFolder folder = make_folder(scratch);
  const pid_t owner = start_owner(folder);
  std::string message;
  EXPECT_EQ(code_of([&] { RunLock second(folder); }, &message), ExitCode::cannot_create);
  EXPECT_NE(message.find("process " + std::to_string(owner)), std::string::npos) << message;
  kill_owner(owner);
}

TEST(RunLock, IsTakenOverFromADeadOne) {
  const ScratchFolder scratch;
  const RunFolder folder = make_folder(scratch);
  kill_owner(start_owner(folder));
  EXPECT_TRUE(std::filesystem::exists(folder.lock()));
  const RunLock lock(folder);
  EXPECT_TRUE(lock.was_left_behind());
}

TEST(RunLock, GoesWithItsOwner) {
  const ScratchFolder scratch;
  const RunFolder folder = make_folder(scratch);
  for (int turn = 0; turn < 2; ++turn) {
    const RunLock lock(folder);
    EXPECT_FALSE(lock.was_left_behind());
    EXPECT_EQ(code_of([&] { RunLock second(folder); }), ExitCode::cannot_create);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.lock()));
}

// The process number may have been given to another process since, or be of this very moment without the lock.
TEST(RunLock, TellsALivingOwnerByItsBeginning) {
  const ScratchFolder scratch;
  const RunFolder folder = make_folder(scratch);
  const pid_t owner = start_owner(folder);
  const std::string text = read_file(folder.lock());
  std::filesystem::remove(folder.lock());  // the system's lock goes with the file: its text alone is left
  write_file_atomically(folder.lock(), text);
  EXPECT_EQ(code_of([&] { RunLock second(folder); }), ExitCode::cannot_create);
  const auto began = text.find("began ") + 6;
  write_file_atomically(folder.lock(), text.substr(0, began) + "9" + text.substr(began));
  EXPECT_EQ(code_of([&] { RunLock second(folder); }), ExitCode::done);
  kill_owner(owner);
}

// A container that is gone had a name of its own. Where the file system is this machine's, the lock that the system
// grants proves that it is gone; where others may write, too, nothing does.
TEST(RunLock, OfAnotherHostIsTakenOverOnALocalFileSystemOnly) {
  const ScratchFolder scratch;
  const RunFolder folder = make_folder(scratch);
  write_file_atomically(folder.lock(), "host elsewhere.example\nprocess 1\nbegan 1@1\n");
  const int descriptor = ::open(scratch.path().c_str(), O_RDONLY);
  const bool is_local = is_on_local_file_system(descriptor);
  ::close(descriptor);
  std::string message;
  std::optional<RunLock> lock;
  const ExitCode code = code_of([&] { lock.emplace(folder); }, &message);
  if (is_local) {
    ASSERT_EQ(code, ExitCode::done) << message;
    EXPECT_TRUE(lock->was_left_behind());
    EXPECT_NE(lock->note().find("process 1 on host elsewhere.example"), std::string::npos) << lock->note();
    EXPECT_EQ(code_of([&] { RunLock second(folder); }), ExitCode::cannot_create);
  } else {
    EXPECT_EQ(code, ExitCode::cannot_create);
    EXPECT_NE(message.find("remove '" + folder.lock().string()), std::string::npos) << message;
    EXPECT_TRUE(std::filesystem::exists(folder.lock()));
  }
}

// Held by the system: alive, whatever it calls its host.
TEST(RunLock, OfALivingContainerIsRefused) {
  const ScratchFolder scratch;
  const RunFolder folder = make_folder(scratch);
  const pid_t owner = start_owner(folder);
  {
    std::ofstream text(folder.lock());  // the same file: the owner's lock stays
    text << "host elsewhere.example\nprocess 7\nbegan 1@1\n";
  }
  std::string message;
  EXPECT_EQ(code_of([&] { RunLock second(folder); }, &message), ExitCode::cannot_create);
  EXPECT_NE(message.find("is being written by process 7 on host elsewhere.example"), std::string::npos) << message;
  kill_owner(owner);
}

TEST(LocalFileSystem, IsOneThatOtherMachinesDoNotHave) {
  for (const std::uint64_t type : {0xef53, 0x58465342, 0x01021994})
    EXPECT_TRUE(is_local_type(type));  // ext4, XFS, tmpfs
  // NFS, Lustre, GPFS, Ceph, FUSE (sshfs), SMB 1 and 2, 9p, AFS, OCFS2, GFS2, BeeGFS, and one that nobody knows
  for (const std::uint64_t type : {0x6969u, 0x0bd00bd0u, 0x47504653u, 0x00c36400u, 0x65735546u, 0x517bu, 0xfe534d42u,
                                   0x01021997u, 0x5346414fu, 0x7461636fu, 0x01161970u, 0x19830326u, 0x12345678u})
    EXPECT_FALSE(is_local_type(type)) << type;
}

}  // namespace
}  // namespace skein
