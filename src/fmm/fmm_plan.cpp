#include <skein/core/error.hpp>
#include <skein/core/math.hpp>
#include <skein/fmm/fmm_plan.hpp>
#include <skein/fmm/machine_rates.hpp>

#include "blob_floor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>

namespace skein {
namespace {

/// One line of the tables. The errors are the largest of random, aligned and balanced forces on clouds, clusters,
/// lines, coils, tubes, shells and sheets, at the sources, with a margin of two or more; ranks are those of the cut-off
/// operators.
struct Row {
  int order;
  double cutoff;
  double error;
  int rank;
  int leaf_size;
};
using Rows = std::span<const Row>;

/// More points than 14 per edge gain nothing: rounding in the operators themselves is met.
constexpr Row harmonic_rows[] = {
    {4, 1e-4, 3e-3, 56, 64},        {5, 1e-5, 5e-4, 90, 64},      {6, 1e-6, 6e-5, 121, 64},
    {7, 1e-7, 8e-6, 168, 100},      {8, 1e-8, 1.5e-6, 200, 90},   {9, 1e-9, 3e-7, 260, 90},
    {10, 1e-10, 6e-8, 350, 180},    {11, 1e-10, 1e-8, 380, 220},  {12, 1e-11, 9e-10, 480, 250},
    {13, 1e-12, 1.5e-10, 600, 300}, {14, 1e-13, 5e-11, 750, 300}, {15, 1e-14, 5e-11, 900, 300},
    {16, 1e-14, 5e-11, 1000, 300},
};

/// Strengths of Stokeslets, S_0 or S_eps. Above 12 points no more is promised. Without the cutoffs blobs are amplified
/// by the small singular values of these operators: at eps = half-width / 10 errors stay at 1e-3 .. 1e-4 whatever the
/// order.
constexpr Row stokeslet_rows[] = {
    {4, 1e-4, 5e-3, 150, 64},     {5, 1e-5, 1e-3, 220, 80},     {6, 1e-6, 2e-4, 300, 100},
    {7, 1e-7, 4e-5, 400, 140},    {8, 1e-8, 1e-5, 500, 180},    {9, 1e-9, 2e-6, 600, 220},
    {10, 1e-9, 1e-6, 700, 250},   {11, 1e-10, 2e-7, 900, 300},  {12, 1e-10, 1e-7, 1000, 300},
    {13, 1e-10, 1e-7, 1100, 300}, {14, 1e-10, 1e-7, 1200, 300}, {15, 1e-10, 1e-7, 1300, 300},
    {16, 1e-10, 1e-7, 1400, 300},
};

/// Errors at targets apart from the sources over those of the tables: at most 7.5 for random forces in cubes, clusters,
/// on lines and tubes, and random targets beside them; up to 34 where forces nearly cancel in pairs, of 600 random sums
/// (test_many_sums).
constexpr double apart_excess = 40.0;

double excess_of(const FmmTargets targets) { return targets == FmmTargets::apart ? apart_excess : 1.0; }

/// What single precision adds, and the smallest singular values it can tell from noise.
constexpr double single_error = 9e-7, single_cutoff = 1e-8;

Rows rows_of(const FarField far_field) {
  switch (far_field) {
    case FarField::harmonic:
      return harmonic_rows;
    case FarField::stokeslet:
    case FarField::regularized:
      return stokeslet_rows;
  }
  throw Error(ExitCode::internal, "rows_of knows no such far field");
}

/// The cheapest row that meets the tolerance, of this order or more.
const Row* find_row(const FmmOptions& options, const int least_order) {
  const Rows rows = rows_of(options.far_field);
  const Row* row = &rows.front();
  while (row != &rows.back() && (row->error > options.tolerance || row->order < least_order)) ++row;
  return row;
}

/// Of the tolerance, that blobs may use up: what the order leaves, or half of it, because the order's own error is
/// seldom as large as its bound.
double blob_share(const FmmOptions& options) {
  return std::max(0.5, 1.0 - find_row(options, options.order)->error / options.tolerance);
}

/// Of an order's error, that the transfers may lose by being taken apart.
constexpr double transfer_share = 0.1;

/// As plans are described.
const char* name_of(const FarField far_field) {
  switch (far_field) {
    case FarField::harmonic:
      return "harmonic";
    case FarField::stokeslet:
      return "Stokeslet";
    case FarField::regularized:
      return "regularized";
  }
  throw Error(ExitCode::internal, "name_of knows no such far field");
}

/// The best that a far field promises.
double least_error(const FmmOptions& options) {
  const Rows rows = rows_of(options.far_field);
  const double error =
      std::min_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.error < b.error; })->error;
  return options.precision == Precision::in_single ? std::max(error, single_error) : error;
}

}  // namespace

double smallest_half_width(const FmmOptions& options, const double max_blob) {
  const double allowed = blob_share(options) * options.tolerance;
  return max_blob / largest_blob_ratio(options, choose_tail_degree(options, allowed), allowed);
}

double single_precision_error(const double min_blob, const double half_width) {
  return 2e-7 + 2e-8 * half_width / min_blob;
}

bool needs_direct_sum(const FmmOptions& options, const FmmTargets targets) {
  return options.tolerance < excess_of(targets) * least_error(options);
}

std::vector<OptionProblem> find_fmm_problems(const FmmOptions& options) {
  std::vector<OptionProblem> problems;
  const Rows rows = rows_of(options.far_field);
  const bool has_tolerance = options.tolerance > 0.0;
  const bool has_order = options.order >= rows.front().order && options.order <= rows.back().order;
  if (!has_tolerance)
    problems.push_back({"tolerance", fmt::format("tolerance = {}: must be positive", options.tolerance)});
  if (options.leaf_size < 0)
    problems.push_back({"leaf_size", fmt::format("leaf_size = {}: must not be negative", options.leaf_size)});
  if (options.order != 0 && !has_order)
    problems.push_back(
        {"order", fmt::format("order = {}: must be between {} and {} with this far field, or 0 to leave it "
                              "to the tolerance",
                              options.order, rows.front().order, rows.back().order)});
  if (!is_tail_degree(options.tail_degree))
    problems.push_back({"tail_degree", fmt::format("tail_degree = {}: must be between 1 and 8, 0 to leave it to the "
                                                   "tolerance, or {} for none",
                                                   options.tail_degree, FmmOptions::no_tail)});
  if (has_tolerance && needs_direct_sum(options))
    problems.push_back(
        {"tolerance",
         fmt::format("tolerance = {:g} is below {:g}, the best that the fast multipole method promises with this far "
                     "field and precision: raise it, or use method = \"direct\"",
                     options.tolerance, least_error(options))});
  if (has_tolerance && has_order) {
    const double error = rows[static_cast<std::size_t>(options.order - rows.front().order)].error;
    if (error > options.tolerance)
      problems.push_back(
          {"order",
           fmt::format("order = {}: its error may be {:g}, above tolerance = {:g}: use a larger order, or 0 to "
                       "leave it to the tolerance",
                       options.order, error, options.tolerance)});
  }
  return problems;
}

void check_fmm_options(const FmmOptions& options) {
  const auto problems = find_fmm_problems(options);
  if (!problems.empty()) throw Error(ExitCode::scene_error, problems.front().message);
}

namespace {

/// How small leaves may be for the blobs, and what it takes.
void set_half_widths(const FmmOptions& options, const double max_blob, const int n_raises, FmmPlan& plan) {
  if (!(max_blob > 0.0)) {
    plan.min_half_width = options.min_half_width;
    return;
  }
  const double allowed = blob_share(options) * options.tolerance;
  const double needed = smallest_half_width(options, max_blob);
  const double plain = max_blob / largest_blob_ratio(options, 0, allowed);
  plan.min_half_width = options.min_half_width > 0.0 ? options.min_half_width : needed;
  if (plan.min_half_width < plain || options.tail_degree > 0) {
    plan.tail_degree = choose_tail_degree(options, allowed);
    plan.plain_half_width = options.tail_degree > 0 ? 0.0 : plain;
  }
  if (plan.min_half_width < 0.999 * needed)
    throw Error(
        ExitCode::scene_error,
        fmt::format("min_half_width = {:g}: leaves this small miss tolerance = {:g} with blobs of {:g} (error floor "
                    "{:g}): use {:.4g} or more, or 0",
                    options.min_half_width, options.tolerance, max_blob,
                    blob_floor(options, plan.tail_degree, max_blob / options.min_half_width), needed));
  // Blobs may have been the cause as well as the order: a quarter of their error with each raise.
  plan.min_half_width *= std::exp2(0.5 * n_raises);
  plan.plain_half_width *= std::exp2(0.5 * n_raises);
  plan.blob_error = blob_floor(options, plan.tail_degree, max_blob / plan.min_half_width);
}

}  // namespace

FmmPlan choose_fmm_plan(const FmmOptions& wanted, const double max_blob, const int raised_order,
                        const FmmTargets targets) {
  check_fmm_options(wanted);
  // What is set by hand stays, and the best that there is has to do where the tolerance leaves no room.
  FmmOptions options = wanted;
  if (wanted.order == 0 && wanted.min_half_width == 0.0)
    options.tolerance =
        std::min(wanted.tolerance, std::max(wanted.tolerance / excess_of(targets), least_error(wanted)));
  const Row* const planned = find_row(options, options.order);
  const Row* const row = find_row(options, math::larger(options.order, raised_order));
  const int n_raises = row->order - planned->order;

  FmmPlan plan;
  plan.order = row->order;
  plan.rank = row->rank;
  plan.far_in_single = options.precision == Precision::in_single ||
                       (options.precision == Precision::automatic &&
                        // After misses, of which single precision may have been the cause, with a margin.
                        options.tolerance >= (1.0 + 9.0 * n_raises) * single_error);
  plan.near_in_single = plan.far_in_single;
  plan.singular_cutoff = options.singular_cutoff > 0.0 && n_raises == 0 ? options.singular_cutoff
                         : plan.far_in_single                           ? std::max(row->cutoff, single_cutoff)
                                                                        : row->cutoff;
  plan.transfer_tolerance = transfer_share * row->error;
  plan.leaf_size = options.leaf_size > 0 ? options.leaf_size
                                         : math::larger(row->leaf_size, machine_rates(options.path).least_leaf_size);
  plan.expected_error = excess_of(targets) * (plan.far_in_single ? std::max(row->error, single_error) : row->error);

  set_half_widths(options, max_blob, n_raises, plan);
  plan.blob_error *= excess_of(targets);
  return plan;
}

std::string describe_fmm_plan(const FmmOptions& options, const FmmPlan& plan) {
  std::string text =
      fmt::format("fast multipole method, {} far field of order {} in {} precision, about {} nodes a leaf",
                  name_of(options.far_field), plan.order, plan.far_in_single ? "single" : "double", plan.leaf_size);
  if (plan.min_half_width > 0.0)
    text += fmt::format(" of half-width {:.3g} or more (for the blobs)", plan.min_half_width);
  if (plan.tail_degree > 0) text += fmt::format(", tails of the blobs by polynomials of degree {}", plan.tail_degree);
  text += fmt::format(", error of at most {:.1g} expected", plan.expected_error);
  if (plan.blob_error > 0.0) text += fmt::format(" by the order and {:.1g} by the blobs", plan.blob_error);
  return text + fmt::format(", {:g} allowed", options.tolerance);
}

}  // namespace skein
