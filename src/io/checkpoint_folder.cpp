#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/run_leftovers.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/trajectory_end.hpp>

#include "segment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>

namespace skein {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view checkpoint_suffix = ".checkpoint";

// Of "000012.checkpoint"; nothing for other names.
std::optional<std::int64_t> number_of(const std::string& name) {
  const std::size_t n_digits = name.size() < checkpoint_suffix.size() ? 0 : name.size() - checkpoint_suffix.size();
  if (n_digits < 1 || n_digits > 18 || !name.ends_with(checkpoint_suffix)) return std::nullopt;
  std::int64_t number = 0;
  for (const char c : name.substr(0, n_digits)) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return std::nullopt;
    number = 10 * number + (c - '0');
  }
  return number;
}

// The new checkpoint is good whether or not this succeeds: one too many does no harm.
void remove_older(const RunFolder& folder, const int keep) {
  try {
    const auto numbers = CheckpointFolder::list_numbers(folder);
    std::error_code ignored;
    for (std::size_t i = 0; i + static_cast<std::size_t>(keep) < numbers.size(); ++i)
      fs::remove(CheckpointFolder::path_of(folder, numbers[i]), ignored);
  } catch (const Error&) {  // the next one tries again
  }
}

/// Why a checkpoint cannot serve.
struct Fault {
  ExitCode code = ExitCode::done;  ///< done: it can
  fs::path path;
  std::string text;
};

Fault why_not(const RunFolder& folder, const fs::path& path, Checkpoint& checkpoint) {
  try {
    checkpoint = read_checkpoint(path);
    check_checkpoint(folder, checkpoint);
    return {};
  } catch (const Error& error) {
    const std::string text = error.what();
    const bool is_named = text.find(path.string()) != std::string::npos;
    return {error.code(), path, is_named ? text : fmt::format("checkpoint '{}' cannot serve: {}", path.string(), text)};
  }
}

// Where no checkpoint can serve, starting again would drop whatever frames there are.
void check_nothing_is_lost(const RunFolder& folder, const std::vector<Fault>& faults) {
  constexpr const char* remedy =
      "Put them back, or drop the frames and start again at the beginning: 'skein resume {} --from-start'.";
  const std::string name = folder.path().string();
  if (!faults.empty()) {
    std::vector<std::string> texts;
    ExitCode code = ExitCode::damaged_data;
    for (const Fault& fault : faults) {
      texts.push_back(fault.text);
      if (fault.code == ExitCode::io_error) code = ExitCode::io_error;
    }
    throw Error(code, fmt::format("none of the {} checkpoints in '{}' is good:\n{}\n{}", faults.size(),
                                  folder.checkpoints().string(), fmt::join(texts, "\n"),
                                  fmt::format(fmt::runtime(remedy), name)));
  }
  if (holds_segments(folder))
    throw Error(ExitCode::damaged_data,
                fmt::format("'{}' has frames in '{}' but no checkpoint in '{}': they are gone or elsewhere. {}", name,
                            folder.segments().string(), folder.checkpoints().string(),
                            fmt::format(fmt::runtime(remedy), name)));
}

/// @param faults  of the newer checkpoints, newest first
ResumePoint look_for_point(const RunFolder& folder, std::vector<Fault>& faults) {
  check_scene_is_of_run(folder);
  const auto numbers = CheckpointFolder::list_numbers(folder);
  ResumePoint point;
  for (auto number = numbers.rbegin(); number != numbers.rend() && !point.checkpoint; ++number) {
    point.path = CheckpointFolder::path_of(folder, *number);
    Checkpoint checkpoint;
    Fault fault = why_not(folder, point.path, checkpoint);
    if (fault.code == ExitCode::done)
      point.checkpoint = std::move(checkpoint);
    else
      faults.push_back(std::move(fault));
  }
  return point;
}

// @returns what became of the file
std::string set_apart(const fs::path& path) {
  std::error_code error;
  fs::rename(path, path.string() + ".damaged", error);
  return error ? fmt::format(" (it cannot be renamed: {})", error.message()) : " (it was renamed to *.damaged)";
}

}  // namespace

CheckpointFolder::CheckpointFolder(const RunFolder& folder) : folder_(folder) {
  std::error_code error;
  fs::create_directories(folder.checkpoints(), error);
  if (error)
    throw Error(ExitCode::io_error, fmt::format("cannot create '{}' (0 bytes written): {}.",
                                                folder.checkpoints().string(), error.message()));
  const auto numbers = list_numbers(folder);
  if (!numbers.empty()) last_number_ = numbers.back();
}

std::vector<std::int64_t> CheckpointFolder::list_numbers(const RunFolder& folder) {
  std::vector<std::int64_t> numbers;
  for (const std::string& name : list_names(folder.checkpoints()))
    if (const auto number = number_of(name)) numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

fs::path CheckpointFolder::path_of(const RunFolder& folder, const std::int64_t number) {
  return folder.checkpoints() / fmt::format("{:06}{}", number, checkpoint_suffix);
}

fs::path CheckpointFolder::path_of(const std::int64_t number) const { return path_of(folder_, number); }

std::uint64_t CheckpointFolder::write(const Checkpoint& checkpoint, const int keep) {
  AtomicFile file(path_of(last_number_ + 1));
  file.write(encode_checkpoint(checkpoint));
  file.commit();
  ++last_number_;
  remove_older(folder_, keep);
  return file.bytes_written();
}

void CheckpointFolder::rehearse(const Checkpoint& checkpoint) const {
  AtomicFile file(folder_.checkpoints() / "rehearsal");
  file.write(encode_checkpoint(checkpoint));
  file.sync();
}

void check_checkpoint(const RunFolder& folder, const Checkpoint& checkpoint) {
  if (checkpoint.text("scene.xxh3") != checksum_of_first_scene(folder))
    throw Error(ExitCode::damaged_data, "it belongs to another scene than this folder's scene.toml");
  check_trajectory(folder, read_trajectory_end(checkpoint), true);
}

ResumePoint find_resume_point(const RunFolder& folder, const bool from_start) {
  std::vector<Fault> faults;
  ResumePoint point = look_for_point(folder, faults);
  if (point.checkpoint && from_start)
    throw Error(ExitCode::usage, fmt::format("'{}' is a good checkpoint, and the run would lose its frames: resume it "
                                             "without --from-start, or compute it anew in another folder.",
                                             point.path.string()));
  if (!point.checkpoint && !from_start) check_nothing_is_lost(folder, faults);
  for (const Fault& fault : faults) point.rejected.push_back(fault.text + set_apart(fault.path));
  return point;
}

ResumePoint look_for_resume_point(const RunFolder& folder) {
  std::vector<Fault> faults;
  ResumePoint point = look_for_point(folder, faults);
  if (!point.checkpoint) check_nothing_is_lost(folder, faults);
  for (const Fault& fault : faults) point.rejected.push_back(fault.text);
  return point;
}

}  // namespace skein
