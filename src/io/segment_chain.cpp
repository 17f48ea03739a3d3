#include "segment_chain.hpp"

#include <skein/core/error.hpp>
#include <skein/io/listed_segments.hpp>
#include <skein/io/run_summary.hpp>

#include <fmt/format.h>

namespace skein {
namespace {

constexpr std::size_t n_digits = 16;

}  // namespace

std::string list_checksums(const std::vector<Segment>& segments) {
  std::string chain;
  for (const Segment& segment : segments) chain += segment.checksum;
  return chain;
}

void check_is_listed(const Hdf5Reader& segment, const std::filesystem::path& path, const std::int64_t number,
                     const std::string& chain) {
  const std::size_t begin = n_digits * static_cast<std::size_t>(number);
  if (chain.empty()) return;
  if (begin + n_digits > chain.size() || segment.text_attribute("/", "xxh3") != chain.substr(begin, n_digits))
    throw Error(
        ExitCode::damaged_data,
        fmt::format("'{}' is not the segment that the run's index lists: it is of another run, or was replaced. "
                    "'skein verify' says more.",
                    path.string()));
}

void check_listed_segments(const RunFolder& folder) {
  const RunSummary summary = read_run_summary(folder.path());
  for (std::int64_t number = 0; number < summary.segments; ++number) {
    const auto path = folder.path() / segment_name(number);
    check_is_listed(Hdf5Reader(path), path, number, summary.chain);
  }
}

}  // namespace skein
