#include "fmm_choices.hpp"

#include <skein/core/error.hpp>

#include "fmm/fmm_paths.hpp"

#include <fmt/format.h>

namespace skein {

std::unique_ptr<FmmSum> make_fmm_sum(const KernelPath path, Communicator* ranks) {
  const bool is_on_host = path == KernelPath::automatic ? on_host<ExecSpace> : path == KernelPath::host;
  if (is_on_host) return make_host_fmm_sum(ranks);
  return make_device_fmm_sum();
}

OctreeRules make_octree_rules(const FmmOptions& options, const FmmPlan& plan) {
  OctreeRules rules;
  rules.leaf_size = plan.leaf_size;
  rules.min_half_width = plan.min_half_width;
  rules.has_quantized_cells = options.far_field == FarField::regularized;
  const int edge = plan.order - 1;
  rules.min_sources_for_expansion = 6 * edge * edge + 2;
  return rules;
}

void settle_plan(const FmmOptions& options, const BlobRange blobs, const double largest_leaf, FmmPlan& plan) {
  if (options.far_field == FarField::regularized && blobs.smallest != blobs.largest)
    throw Error(
        ExitCode::scene_error,
        fmt::format("far_field = \"regularized\" needs one blob for all nodes, not {:g} .. {:g}: use \"harmonic\"",
                    blobs.smallest, blobs.largest));
  if (options.precision == Precision::automatic)
    plan.near_in_single &= single_precision_error(blobs.smallest, largest_leaf) < options.tolerance;
}

}  // namespace skein
