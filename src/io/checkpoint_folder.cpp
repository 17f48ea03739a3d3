#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint_folder.hpp>
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

void remove_older(const RunFolder& folder, const int keep) {
  const auto numbers = CheckpointFolder::list_numbers(folder);
  std::error_code ignored;  // one too many does no harm
  for (std::size_t i = 0; i + static_cast<std::size_t>(keep) < numbers.size(); ++i)
    fs::remove(CheckpointFolder::path_of(folder, numbers[i]), ignored);
}

std::string why_not(const RunFolder& folder, const fs::path& path, Checkpoint& checkpoint) {
  try {
    checkpoint = read_checkpoint(path);
    const std::string fault = find_checkpoint_fault(folder, checkpoint);
    return fault.empty() ? "" : fmt::format("checkpoint '{}' cannot serve: {}", path.string(), fault);
  } catch (const Error& error) {
    return error.what();
  }
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
  std::error_code error;
  for (fs::directory_iterator entry(folder.checkpoints(), error), end; !error && entry != end; entry.increment(error))
    if (const auto number = number_of(entry->path().filename().string())) numbers.push_back(*number);
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

std::string find_checkpoint_fault(const RunFolder& folder, const Checkpoint& checkpoint) {
  if (checkpoint.text("scene.xxh3") != checksum_of_file(folder.scene()))
    return "it belongs to another scene than this folder's scene.toml";
  return find_missing_segments(folder, read_trajectory_end(checkpoint), true);
}

ResumePoint find_resume_point(const RunFolder& folder) {
  const auto numbers = CheckpointFolder::list_numbers(folder);
  ResumePoint point;
  std::vector<fs::path> bad;
  for (auto number = numbers.rbegin(); number != numbers.rend() && !point.checkpoint; ++number) {
    point.path = CheckpointFolder::path_of(folder, *number);
    Checkpoint checkpoint;
    const std::string fault = why_not(folder, point.path, checkpoint);
    if (fault.empty()) {
      point.checkpoint = std::move(checkpoint);
    } else {
      point.rejected.push_back(fault);
      bad.push_back(point.path);
    }
  }
  if (!numbers.empty() && !point.checkpoint)
    throw Error(
        ExitCode::damaged_data,
        fmt::format("none of the {} checkpoints in '{}' is good:\n{}\nThe scene is whole: 'skein run {} -o DIR' "
                    "computes the run again.",
                    numbers.size(), folder.checkpoints().string(), fmt::join(point.rejected, "\n"),
                    folder.scene().string()));
  std::error_code ignored;
  for (const fs::path& path : bad) fs::rename(path, path.string() + ".damaged", ignored);
  return point;
}

}  // namespace skein
