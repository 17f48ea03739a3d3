#include "fmm_choices.hpp"

#include <skein/core/error.hpp>
#include <skein/fmm/fmm_cost.hpp>
#include <skein/fmm/machine_rates.hpp>

#include "fmm/blob_floor.hpp"
#include "fmm/fmm_paths.hpp"

#include <fmt/format.h>

namespace skein {

std::unique_ptr<FmmSum> make_fmm_sum(const KernelPath path, Communicator* ranks) {
  const bool is_on_host = path == KernelPath::automatic ? on_host<ExecSpace> : path == KernelPath::host;
  return is_on_host ? make_host_fmm_sum(ranks) : make_device_fmm_sum(ranks);
}

bool FmmSum::take_part(const Sources&, const RankParts&) {
  throw Error(ExitCode::internal, "a sum of one process has no parts");
}

OctreeRules make_octree_rules(const FmmOptions& options, const FmmPlan& plan) {
  OctreeRules rules;
  rules.leaf_size = plan.leaf_size;
  rules.min_half_width = plan.min_half_width;
  if (plan.tail_degree > 0 && plan.plain_half_width > 0.0) {
    rules.easy_half_width = plan.plain_half_width;
    FmmPlan plain = plan;
    plain.tail_degree = 0;
    const auto cost = [&](const FmmWork& work, const FmmPlan& by) {
      return estimate_nanoseconds(work, by, true, options.path);
    };
    const double node = cost({.n_sources = 2.0}, plain);  // a source and a target
    rules.costs = {cost({.near_pairs = 1.0}, plan), cost({.far_pairs = 1.0}, plan), cost({.n_boxes = 1.0}, plan),
                   node - 2.0 * machine_rates(options.path).node, cost({.n_sources = 2.0}, plan) - node};
  }
  rules.has_quantized_cells = options.far_field == FarField::regularized;
  const int edge = plan.order - 1;
  rules.min_sources_for_expansion = 6 * edge * edge + 2;
  return rules;
}

void settle_plan(const FmmOptions& options, const BlobRange blobs, const LeafRange leaves, FmmPlan& plan) {
  if (options.far_field == FarField::regularized && blobs.smallest != blobs.largest)
    throw Error(
        ExitCode::scene_error,
        fmt::format("far_field = \"regularized\" needs one blob for all nodes, not {:g} .. {:g}: use \"harmonic\"",
                    blobs.smallest, blobs.largest));
  if (plan.tail_degree > 0 && options.tail_degree == 0 && leaves.smallest >= 0.999 * plan.plain_half_width) {
    plan.blob_error *= blob_floor(options, 0, blobs.largest / plan.plain_half_width) /
                       blob_floor(options, plan.tail_degree, blobs.largest / plan.min_half_width);
    plan.min_half_width = plan.plain_half_width;
    plan.tail_degree = 0;
  }
  if (options.precision == Precision::automatic)
    plan.near_in_single &= single_precision_error(blobs.smallest, leaves.largest) < options.tolerance;
}

}  // namespace skein
