#include "fmm/node_deal.hpp"

#include <skein/core/error.hpp>

#include "fmm/host_workers.hpp"
#include "fmm/shared_cube.hpp"

#include <algorithm>
#include <cstring>

namespace skein {
namespace {

constexpr int rows_at_once = 1024;  // by a thread

/// use(i) for i = 0 .. n - 1, in parallel.
template <class Use>
void for_rows(const char* label, const int n, const Use& use) {
  for_tasks(label, math::ceil_div(n, rows_at_once), [&](const int task) {
    const int end = math::smaller(n, (task + 1) * rows_at_once);
    for (int i = task * rows_at_once; i < end; ++i) use(i);
  });
}

/// Of keys that stand in order, how many each rank gets.
std::vector<std::size_t> count_for_ranks(const TopTree& top, const int max_depth, const SortedKeys& own,
                                         const int n_ranks) {
  std::vector<std::size_t> n_to(static_cast<std::size_t>(n_ranks));
  auto next = own.key.begin();
  for (std::size_t i = 0; i < top.leaves.size(); ++i) {
    auto end = own.key.end();
    if (i + 1 < top.leaves.size())
      end = std::lower_bound(next, end, first_key(top.boxes[static_cast<std::size_t>(top.leaves[i + 1])], max_depth));
    n_to[static_cast<std::size_t>(top.owner[static_cast<std::size_t>(top.leaves[i])])] +=
        static_cast<std::size_t>(end - next);
    next = end;
  }
  return n_to;
}

}  // namespace

IndexRange NodeDeal::own_places() const {
  const auto r = static_cast<std::size_t>(rank_);
  return {top_.first_node[r], top_.first_node[r + 1] - top_.first_node[r]};
}

void NodeDeal::build(Communicator& ranks, const ConstVectorView<HostSpace>& own, const RankParts& owners,
                     const OctreeRules& rules, HostOctree& memory) {
  const HostSpace space;
  rank_ = ranks.rank();
  cube_ = choose_shared_cube(ranks, own, owners, rules, memory);
  const auto n_own = static_cast<std::size_t>(own.extent(0));
  KeyedOrder<HostSpace>& keyed = memory.sources;
  keyed.require(n_own);
  make_keys<HostSpace>(space, own, make_key_of(cube_.corner, cube_.side, cube_.max_depth), 1, keyed);
  sort_by_key(space, keyed, own.extent_int(0), 3 * cube_.max_depth, memory.sort_memory);
  if (work_.size() != n_own) work_.assign(n_own, 1.0f);
  std::vector<int> rows(keyed.order.data(), keyed.order.data() + n_own);
  std::vector<double> work_before = {0.0};
  work_before.reserve(n_own + 1);
  for (const int row : rows) work_before.push_back(work_before.back() + work_[static_cast<std::size_t>(row)]);
  const SortedKeys sorted{{keyed.key.data(), n_own}, work_before};
  top_ = make_top_tree(ranks, cube_, sorted, static_cast<int>(owners.total()));

  to_places_.agree(ranks, std::move(rows), count_for_ranks(top_, cube_.max_depth, sorted, ranks.size()));
  static_assert(sizeof(std::uint64_t) == sizeof(double));
  std::vector<double> keys(n_own);
  if (n_own > 0) std::memcpy(keys.data(), keyed.key.data(), n_own * sizeof(double));
  const std::vector<double> received = to_places_.send(ranks, keys, 1);
  const std::size_t n_here = received.size();
  SKEIN_REQUIRE(n_here == static_cast<std::size_t>(own_places().count), "places and nodes differ in number");
  // Ranks own nodes in their order, so that equal keys keep the order of all nodes.
  keyed.require(n_here);
  for (std::size_t i = 0; i < n_here; ++i) {
    std::memcpy(&keyed.key(i), &received[i], sizeof(double));
    keyed.order(i) = static_cast<int>(i);
  }
  sort_by_key(space, keyed, static_cast<int>(n_here), 3 * cube_.max_depth, memory.sort_memory);
  slot_of_place_.assign(keyed.order.data(), keyed.order.data() + n_here);
  place_key_.assign(keyed.key.data(), keyed.key.data() + n_here);
  has_new_work_ = false;
}

void NodeDeal::move(Communicator& ranks, const ConstVectorView<HostSpace>& own, const double scale, const int first,
                    const HostVectors& here) {
  const std::vector<int>& rows = to_places_.rows();
  std::vector<double> numbers(3 * rows.size());
  for_rows("skein::NodeDeal::pack", static_cast<int>(rows.size()), [&](const int i) {
    for (int c = 0; c < 3; ++c)
      numbers[static_cast<std::size_t>(3 * i + c)] = scale * own(rows[static_cast<std::size_t>(i)], c);
  });
  const std::vector<double> received = to_places_.send(ranks, numbers, 3);
  for_rows("skein::NodeDeal::place", static_cast<int>(slot_of_place_.size()), [&](const int place) {
    const double* const from = received.data() + 3 * slot_of_place_[static_cast<std::size_t>(place)];
    for (int c = 0; c < 3; ++c) here(first + place, c) = from[c];
  });
}

void NodeDeal::move(Communicator& ranks, const ConstScalarView<HostSpace>& own, const int first,
                    const HostScalars& here) {
  std::vector<double> numbers;
  for (const int row : to_places_.rows()) numbers.push_back(own(row));
  const std::vector<double> received = to_places_.send(ranks, numbers, 1);
  int place = first;
  for (const int slot : slot_of_place_) here(place++) = received[static_cast<std::size_t>(slot)];
}

void NodeDeal::return_velocities(Communicator& ranks, const HostVectors& here, const int first,
                                 const HostVectors& own) {
  const std::size_t n_here = slot_of_place_.size();
  std::vector<double> numbers(3 * n_here);
  for_rows("skein::NodeDeal::pack_velocities", static_cast<int>(n_here), [&](const int place) {
    double* const to = numbers.data() + 3 * slot_of_place_[static_cast<std::size_t>(place)];
    for (int c = 0; c < 3; ++c) to[c] = here(first + place, c);
  });
  const std::vector<double> velocity = to_places_.send_back(ranks, numbers, 3);
  const std::vector<int>& rows = to_places_.rows();
  for_rows("skein::NodeDeal::place_velocities", static_cast<int>(rows.size()), [&](const int i) {
    for (int c = 0; c < 3; ++c)
      own(rows[static_cast<std::size_t>(i)], c) = velocity[static_cast<std::size_t>(3 * i + c)];
  });
  // Noted by all ranks after a new tree, or by none; those without places have none to note.
  if (!has_new_work_) return;
  has_new_work_ = false;
  numbers.resize(n_here);
  for (std::size_t place = 0; place < n_here; ++place)
    numbers[static_cast<std::size_t>(slot_of_place_[place])] = place_work_[place];
  place_work_ = {};
  const std::vector<double> work = to_places_.send_back(ranks, numbers, 1);
  for (std::size_t i = 0; i < rows.size(); ++i) work_[static_cast<std::size_t>(rows[i])] = static_cast<float>(work[i]);
}

}  // namespace skein
