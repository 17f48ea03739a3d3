#include "node_parts.hpp"

#include <skein/arrays/combination.hpp>
#include <skein/arrays/node_vectors.hpp>
#include <skein/core/error.hpp>

#include "seen_rows.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace skein {
namespace {

/// Of a rank's nodes: chunks of a dot product that are its alone, and the nodes before and behind them.
struct ChunkShare {
  std::size_t head = 0, n_chunks = 0, chunk_nodes = 0, tail = 0;

  /// @param size  nodes of a chunk
  ChunkShare(const RankParts& owners, const std::size_t rank, const std::size_t size) {
    const std::size_t first = owners.first[rank], end = first + owners.count[rank];
    const std::size_t first_chunk = (first + size - 1) / size;
    const std::size_t end_chunk = end == owners.total() ? (end + size - 1) / size : end / size;
    if (end_chunk <= first_chunk) {
      head = end - first;
      return;
    }
    const std::size_t last = std::min(end_chunk * size, end);
    head = first_chunk * size - first;
    n_chunks = end_chunk - first_chunk;
    chunk_nodes = last - first_chunk * size;
    tail = end - last;
  }
  std::size_t n_single() const { return head + tail; }
  std::size_t n_numbers(const std::size_t n_arrays) const { return n_chunks + 3 * n_arrays * n_single(); }
};

void append_rows(const SeenRows& rows, const std::size_t first, const std::size_t n, std::vector<double>& numbers) {
  rows.look(first, n);
  for (std::size_t i = first; i < first + n; ++i)
    for (std::size_t c = 0; c < 3; ++c) numbers.push_back(rows(i, c));
}

}  // namespace

Vectors make_part(const std::string& label, const RankParts& owners, const int rank) {
  return Vectors(label, std::max<std::size_t>(1, owners.count[static_cast<std::size_t>(rank)]));
}

Vectors rows_of(const Vectors& whole, const std::size_t first, const std::size_t n) {
  return Kokkos::subview(whole, std::make_pair(first, first + n), Kokkos::ALL());
}

Vectors own_rows(const Vectors& part, const RankParts& owners, const int rank) {
  return rows_of(part, 0, owners.count[static_cast<std::size_t>(rank)]);
}

void gather_rows_to_all(Communicator& ranks, const RankParts& owners, const Vectors& whole, const RowAccess access) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const SeenRows seen(whole, access, ranks.reaches_device_memory(), 0);
  seen.look(owners.first[rank], owners.count[rank]);
  ranks.gather_to_all({seen.column(0), seen.column(1), seen.column(2)}, owners);
  seen.take(0, owners.total());
}

void gather_parts_to_all(Communicator& ranks, const RankParts& owners, const Vectors& part, const Vectors& whole,
                         const RowAccess access) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  Kokkos::deep_copy(ExecSpace(), rows_of(whole, owners.first[rank], owners.count[rank]),
                    own_rows(part, owners, ranks.rank()));
  gather_rows_to_all(ranks, owners, whole, access);
}

void gather_parts(Communicator& ranks, const RankParts& owners, const Vectors& part, const Vectors& whole,
                  const RowAccess access) {
  const bool receives = ranks.rank() == 0;
  const bool reaches = ranks.reaches_device_memory();
  const SeenRows sent(part, access, reaches, 0), received(receives ? whole : Vectors(), access, reaches, 1);
  sent.look(0, owners.count[static_cast<std::size_t>(ranks.rank())]);
  for (std::size_t c = 0; c < 3; ++c) ranks.gather(sent.column(c), owners, receives ? received.column(c) : nullptr);
  if (receives) received.take(0, owners.total());
}

void scatter_parts(Communicator& ranks, const RankParts& owners, const Vectors& whole, const Vectors& part,
                   const RowAccess access) {
  const bool sends = ranks.rank() == 0;
  const std::vector<std::size_t> none(owners.count.size());
  RankParts from_rank_0{none, none};
  from_rank_0.count[0] = owners.count[static_cast<std::size_t>(ranks.rank())];
  const bool reaches = ranks.reaches_device_memory();
  const SeenRows received(part, access, reaches, 0), sent(sends ? whole : Vectors(), access, reaches, 1);
  if (sends) sent.look(0, owners.total());
  for (std::size_t c = 0; c < 3; ++c)
    ranks.exchange(sends ? sent.column(c) : nullptr, sends ? owners : RankParts{none, none}, received.column(c),
                   from_rank_0);
  received.take(0, from_rank_0.count[0]);
}

void gather_needed_rows(Communicator& ranks, const RankParts& owners, const NeededRows& needed, const Vectors& part,
                        const Vectors& whole, const RowAccess access) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const std::size_t own_first = owners.first[rank], own_end = own_first + owners.count[rank];
  const std::size_t first = needed.first[rank], end = needed.end[rank];
  Kokkos::deep_copy(ExecSpace(), rows_of(whole, own_first, owners.count[rank]), own_rows(part, owners, ranks.rank()));
  const RowsInTransit rows = list_rows_in_transit(owners, needed, ranks.rank());
  const bool reaches = ranks.reaches_device_memory();
  // Of the whole only the rows that are needed here, so that there are copies of no others.
  const SeenRows own(part, access, reaches, 0), there(rows_of(whole, first, end - first), access, reaches, 1);
  own.look(0, owners.count[rank]);
  for (std::size_t c = 0; c < 3; ++c) ranks.exchange(own.column(c), rows.sent, there.column(c), rows.received);
  there.take(0, own_first - first);
  there.take(own_end - first, end - own_end);
}

Vectors gather_means(Communicator& ranks, const RankParts& owners, const RankParts& owned, const Sections& sections,
                     const Vectors& vector, const RowAccess access) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const Vectors mean("skein::gather_means::mean", owned.total());
  sections.compute_means_on(static_cast<int>(owners.first[rank]), static_cast<int>(owners.count[rank]), vector, mean);
  gather_rows_to_all(ranks, owned, mean, access);
  return mean;
}

Vectors gather_for_forces(Communicator& ranks, const RankParts& owners, const NeededRows& needed,
                          const Sections& sections, const bool is_local, const Vectors& part, const Vectors& whole) {
  if (!is_local) {
    gather_parts_to_all(ranks, owners, part, whole);
    return {};
  }
  gather_needed_rows(ranks, owners, needed, part, whole);
  if (needed.sections.count.empty()) return {};
  return gather_means(ranks, owners, needed.sections, sections, whole);
}

double add_up_products(Communicator& ranks, const RankParts& owners, const Vectors& part, const Vectors& other,
                       const RowAccess access) {
  const int at_once = choose_dot_chunk<ExecSpace>(static_cast<int>(owners.total()));
  const auto chunk_nodes = static_cast<std::size_t>(at_once);
  const std::size_t n_arrays = part.data() == other.data() ? 1 : 2;
  std::vector<ChunkShare> shares;
  std::vector<std::size_t> counts;
  for (std::size_t rank = 0; rank < owners.count.size(); ++rank) {
    shares.emplace_back(owners, rank, chunk_nodes);
    counts.push_back(shares.back().n_numbers(n_arrays));
  }
  const ExecSpace space;
  const ChunkShare& own = shares[static_cast<std::size_t>(ranks.rank())];
  std::vector<double> numbers;
  if (own.n_chunks > 0)
    numbers = dot_chunks<ExecSpace>(space, rows_of(part, own.head, own.chunk_nodes),
                                    rows_of(other, own.head, own.chunk_nodes), at_once);
  for (std::size_t array = 0; array < n_arrays; ++array) {
    const SeenRows seen(array == 0 ? part : other, access, false, 0);  // they are read here
    append_rows(seen, 0, own.head, numbers);
    append_rows(seen, own.head + own.chunk_nodes, own.tail, numbers);
  }
  const RankParts parts = RankParts::behind_each_other(std::move(counts));
  std::vector<double> all(ranks.rank() == 0 ? parts.total() : 0);
  ranks.gather(numbers.data(), parts, all.data());
  if (ranks.rank() != 0) return 0.0;

  // Nodes of chunks that are several ranks' come together here, so that the same kernel adds them up.
  std::size_t n_single = 0;
  for (const ChunkShare& share : shares) n_single += share.n_single();
  Vectors single[2];
  for (std::size_t array = 0; array < n_arrays; ++array) {
    single[array] = Vectors("skein::add_up_products::single", n_single);
    const auto on_host = Kokkos::create_mirror_view(single[array]);
    std::size_t next = 0;
    for (std::size_t rank = 0; rank < shares.size(); ++rank) {
      const double* number =
          all.data() + parts.first[rank] + shares[rank].n_chunks + 3 * array * shares[rank].n_single();
      for (std::size_t i = 0; i < shares[rank].n_single(); ++i, ++next)
        for (int c = 0; c < 3; ++c) on_host(next, c) = *number++;
    }
    Kokkos::deep_copy(single[array], on_host);
  }
  std::vector<double> of_single;
  if (n_single > 0) of_single = dot_chunks<ExecSpace>(space, single[0], single[n_arrays - 1], at_once);
  // Chunks in their order: a rank's own ones begin behind the one that its head ends.
  double total = 0.0;
  std::size_t n_seen = 0, n_added = 0;  // of single nodes, and of the chunks of such
  const auto add_single = [&](const std::size_t n_nodes, const bool ends) {
    n_seen += n_nodes;
    for (; n_added < (ends ? (n_seen + chunk_nodes - 1) / chunk_nodes : n_seen / chunk_nodes); ++n_added)
      total += of_single[n_added];
  };
  for (std::size_t rank = 0; rank < shares.size(); ++rank) {
    add_single(shares[rank].head, false);
    const double* const of_rank = all.data() + parts.first[rank];
    for (std::size_t chunk = 0; chunk < shares[rank].n_chunks; ++chunk) total += of_rank[chunk];
    add_single(shares[rank].tail, false);
  }
  add_single(0, true);
  return total;
}

void NodeParts::work(const PartWork& work) {
  switch (work.kind) {
    case PartWork::Kind::make:
      parts_[work.result] = make_part("skein::NodeParts::part", owners_, rank_);
      return;
    case PartWork::Kind::drop:
      parts_.erase(work.result);
      return;
    case PartWork::Kind::copy:
      return Kokkos::deep_copy(ExecSpace(), parts_.at(work.result), parts_.at(work.source[0]));
    case PartWork::Kind::set_to_zero:
      return Kokkos::deep_copy(ExecSpace(), parts_.at(work.result), 0.0);
    case PartWork::Kind::combine: {
      const auto term = [&](const int i) { return Term<ExecSpace>{work.factor[i], parts_.at(work.source[i])}; };
      const Vectors& result = parts_.at(work.result);
      NodeVectors& whole = whole_vectors();
      if (work.n_terms == 2) return whole.combine(result, {term(0), term(1)});
      if (work.n_terms == 4) return whole.combine(result, {term(0), term(1), term(2), term(3)});
      return whole.combine(result, {term(0), term(1), term(2), term(3), term(4)});
    }
    case PartWork::Kind::add_fmm_sum:
      break;
  }
  throw Error(ExitCode::internal, "work of no known kind on parts of arrays");
}

}  // namespace skein
