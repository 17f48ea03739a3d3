#include "fmm/team_sum.hpp"

#include "fmm/fmm_evaluator.hpp"
#include "fmm/fmm_paths.hpp"
#include "fmm/team_transfers.hpp"

namespace skein {

template <class Space, class Real, class Field>
void transfer_by_teams(const Space& space, const Passes<Space, Real, Field>& passes, const FarOrder<Space>& far,
                       const std::vector<int>& runs, const Kokkos::View<Real*, Space>& products, const int team_size) {
  Kokkos::deep_copy(space, passes.coefficients.target, Real(0));
  const int n_boxes = passes.n_boxes;
  for (std::size_t run = 0; run + 1 < runs.size(); ++run) {
    const int begin = runs[run], end = runs[run + 1];
    if (begin == end) continue;
    const TransferProducts<Space, Real, Field> multiply(passes, far, begin, end, products.data());
    Kokkos::parallel_for(
        "skein::run_m2l",
        make_team_policy(space, multiply.n_teams(), team_size, multiply.scratch_level, multiply.scratch_bytes()),
        multiply);
    Kokkos::parallel_for("skein::add_transfers", make_team_policy(space, n_boxes, team_size, 0, 0),
                         AddTransfers<Space, Real, Field>{passes, far.place, far.targets, begin, end, products.data()});
  }
}

template class FmmEvaluator<TeamWorkers>;

std::unique_ptr<FmmSum> make_device_fmm_sum(Communicator* ranks) {
  return std::make_unique<FmmEvaluator<TeamWorkers>>(TeamWorkers(), ranks);
}

}  // namespace skein
