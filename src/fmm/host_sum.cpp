#include "fmm/host_sum.hpp"

#include "fmm/fmm_evaluator.hpp"
#include "fmm/fmm_paths.hpp"
#include "fmm/tail_packs.hpp"

#include <algorithm>
#include <string>

namespace skein {
namespace {

/// Boxes whose V lists make one task: of one level. @param boxes_of_level  that are to be in a task
std::vector<IndexRange> make_transfer_tasks(const Kokkos::View<int*, HostSpace>& first_pair,
                                            const std::vector<IndexRange>& boxes_of_level) {
  constexpr int min_pairs = 48, max_boxes = 64;
  std::vector<IndexRange> tasks;
  for (std::size_t level = first_far_level; level < boxes_of_level.size(); ++level) {
    const IndexRange boxes = boxes_of_level[level];
    IndexRange task{boxes.first, 0};
    int n_pairs = 0;
    const int enough = math::larger(min_pairs, (first_pair(boxes.first + boxes.count) - first_pair(boxes.first)) / 16);
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      ++task.count;
      n_pairs += first_pair(b + 1) - first_pair(b);
      if (n_pairs >= enough || task.count == max_boxes) {
        tasks.push_back(task);
        task = {b + 1, 0};
        n_pairs = 0;
      }
    }
    if (task.count > 0) tasks.push_back(task);
  }
  return tasks;
}

/// The V lists of some boxes of one level: pairs in the order of their operators, and of the lists among equals.
template <class Real, class Field>
void transfer_to(const Passes<HostSpace, Real, Field>& passes, const IndexRange boxes) {
  const LevelOperators<Real>& operators = passes.operators_of(passes.boxes(boxes.first));
  const int size = passes.coefficients.box_size, stride = passes.coefficients.stride;
  std::fill_n(passes.target_of(boxes.first), static_cast<std::ptrdiff_t>(boxes.count) * size, Real(0));
  const auto& list = passes.v_list;
  const FarPair* const pairs = list.entries.data() + list.first(boxes.first);
  const int n_pairs = list.first(boxes.first + boxes.count) - list.first(boxes.first);
  int place[n_transfers + 1] = {};
  for (int k = 0; k < n_pairs; ++k) ++place[transfer_index(pairs[k].transfer) + 1];
  for (int index = 0; index < n_transfers; ++index) place[index + 1] += place[index];
  const HostScratch<int> order(math::larger(1, n_pairs));
  int next[n_transfers];
  std::copy(place, place + n_transfers, next);
  for (int k = 0; k < n_pairs; ++k) order.data()[next[transfer_index(pairs[k].transfer)]++] = k;

  HostBatch<Real, Field> batch(operators.rank_padded, operators.rank_padded);
  for (int index = 0; index < n_transfers; ++index) {
    const Matrix<Real>&last = operators.transfer_last[index], &first = operators.transfer_first[index];
    for (int k = place[index]; k < place[index + 1]; ++k) {
      const FarPair& pair = pairs[order.data()[k]];
      const Real* const sign = operators.sign_of(reflected_axes(pair.transfer));
      const Real shift[3] = {Real(2 * pair.transfer[0]), Real(2 * pair.transfer[1]), Real(2 * pair.transfer[2])};
      batch.add(passes.source_of(pair.source), stride, operators.rank_padded, sign, Real(1), shift,
                passes.target_of(pair.target), sign);
      if (batch.is_full()) batch.apply(last, first, stride);
    }
    batch.apply(last, first, stride);
  }
}

}  // namespace

template <class Real, class Field>
void transfer_on_host(const Passes<HostSpace, Real, Field>& passes, const std::vector<IndexRange>& boxes_of_level) {
  const std::vector<IndexRange> tasks = make_transfer_tasks(passes.v_list.first, boxes_of_level);
  for_tasks("skein::run_m2l", static_cast<int>(tasks.size()),
            [&](const int t) { transfer_to(passes, tasks[static_cast<std::size_t>(t)]); });
}

template <class Near>
NearField HostWorkers::compute_near(const SortedNodes<Space>& nodes, const Lists<IndexRange, Space>& u_list,
                                    const Kokkos::View<const int*, Space>& near_end) {
  if (near_matches_.tiles.empty()) return {u_list.entries.data(), u_list.first.data(), near_end.data(), {}, 0, nullptr};
  const int n_packed = near_matches_.n_packed();
  if (near_velocity_.extent_int(0) != 3 * n_packed)
    near_velocity_ =
        HostScalars(Kokkos::view_alloc(std::string("skein::host_workers::near_velocity"), Kokkos::WithoutInitializing),
                    3 * n_packed);
  if constexpr (std::is_same_v<Near, float>)
    single_near_tiles_.compute(nodes, near_matches_, near_velocity_);
  else
    near_tiles_.compute(nodes, near_matches_, near_velocity_);
  const int* const first = near_matches_.one_way.first.data();
  return {near_matches_.one_way.entries.data(), first, first + 1, near_velocity_, n_packed,
          near_matches_.leaf_first.data()};
}

template class FmmEvaluator<HostWorkers>;

std::unique_ptr<FmmSum> make_host_fmm_sum(Communicator* ranks) {
  return std::make_unique<FmmEvaluator<HostWorkers>>(HostWorkers{}, ranks);
}

}  // namespace skein
