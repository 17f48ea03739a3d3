#include <skein/core/error.hpp>
#include <skein/ranks/communicator.hpp>

#include <algorithm>
#include <utility>

namespace skein {

RankParts RankParts::behind_each_other(std::vector<std::size_t> count) {
  RankParts parts;
  std::size_t next = 0;
  for (const std::size_t n : count) {
    parts.first.push_back(next);
    next += n;
  }
  parts.count = std::move(count);
  return parts;
}

void LoneProcess::gather(const double* own, const RankParts& parts, double* all) {
  std::copy_n(own, parts.count[0], all + parts.first[0]);
}

void LoneProcess::exchange(const double* send, const RankParts& sent, double* receive, const RankParts& received) {
  std::copy_n(send + sent.first[0], sent.count[0], receive + received.first[0]);
}

void LoneProcess::fail(const int exit_code, const std::string& message) {
  throw Error(static_cast<ExitCode>(exit_code), message);
}

}  // namespace skein
