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

RankParts RankParts::evenly(const std::size_t n, const int n_ranks) {
  const auto r = static_cast<std::size_t>(n_ranks);
  std::vector<std::size_t> count;
  for (std::size_t rank = 0; rank < r; ++rank) count.push_back(n * (rank + 1) / r - n * rank / r);
  return behind_each_other(std::move(count));
}

void add_up_to_all(Communicator& ranks, std::vector<double>& numbers) {
  // A part of the numbers is one rank's, to which all others send theirs.
  const auto n_ranks = static_cast<std::size_t>(ranks.size()), rank = static_cast<std::size_t>(ranks.rank());
  const RankParts parts = RankParts::evenly(numbers.size(), ranks.size());
  const std::size_t n_own = parts.count[rank];
  const RankParts received = RankParts::behind_each_other(std::vector<std::size_t>(n_ranks, n_own));
  std::vector<double> there(received.total());
  ranks.exchange(numbers.data(), parts, there.data(), received);
  for (std::size_t i = 0; i < n_own; ++i) {
    double sum = 0.0;
    for (std::size_t r = 0; r < n_ranks; ++r) sum += there[received.first[r] + i];
    numbers[parts.first[rank] + i] = sum;
  }
  ranks.gather_to_all({numbers.data()}, parts);
}

std::vector<double> list_from_all(Communicator& ranks, const std::vector<double>& own) {
  const RankParts parts =
      RankParts::behind_each_other(std::vector<std::size_t>(static_cast<std::size_t>(ranks.size()), own.size()));
  std::vector<double> all(parts.total());
  std::copy(own.begin(), own.end(), all.begin() + static_cast<std::ptrdiff_t>(own.size()) * ranks.rank());
  ranks.gather_to_all({all.data()}, parts);
  return all;
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
