#include "kernels/node_checks.hpp"

#include <skein/arrays/launch.hpp>

#include <algorithm>

namespace skein {
namespace {

/// Of the three axes and the blobs.
struct Extremes {
  double low[4], high[4];
  int n_faulty;  ///< runs with positions that are not finite
};

/// Joins what was seen of some nodes and of others.
class JoinExtremes {
 public:
  using reducer = JoinExtremes;
  using value_type = Extremes;
  using result_view_type = Kokkos::View<Extremes, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>;

  KOKKOS_INLINE_FUNCTION explicit JoinExtremes(Extremes& result) : result_(&result) {}

  KOKKOS_INLINE_FUNCTION void init(Extremes& seen) const {
    for (int c = 0; c < 4; ++c) {
      seen.low[c] = NodeBounds::most;
      seen.high[c] = -NodeBounds::most;
    }
    seen.n_faulty = 0;
  }
  KOKKOS_INLINE_FUNCTION void join(Extremes& seen, const Extremes& other) const { join_one(seen, other); }
  /// Kokkos before 3.7 asks for this one.
  KOKKOS_INLINE_FUNCTION void join(volatile Extremes& seen, const volatile Extremes& other) const {
    join_one(seen, other);
  }
  KOKKOS_INLINE_FUNCTION Extremes& reference() const { return result_(); }
  KOKKOS_INLINE_FUNCTION result_view_type view() const { return result_; }
  KOKKOS_INLINE_FUNCTION bool references_scalar() const { return true; }

 private:
  template <class Seen, class Other>
  KOKKOS_INLINE_FUNCTION static void join_one(Seen& seen, const Other& other) {
    for (int c = 0; c < 4; ++c) {
      if (other.low[c] < seen.low[c]) seen.low[c] = other.low[c];
      if (other.high[c] > seen.high[c]) seen.high[c] = other.high[c];
    }
    seen.n_faulty = seen.n_faulty + other.n_faulty;
  }

  result_view_type result_;
};

/// Looks at a run of nodes, or at one on a device; several at a time, because each comparison waits for the one before.
template <class Space>
struct LookAtNodes {
  static constexpr int lanes = on_host<Space> ? 16 : 1, run = on_host<Space> ? 2048 : 1;

  ConstVectorView<Space> source, target;
  ConstScalarView<Space> blob;

  KOKKOS_INLINE_FUNCTION void operator()(const int k, Extremes& seen) const {
    bool is_faulty = false;
    for (int c = 0; c < 3; ++c) {
      look([this, c](const int i) { return source(i, c); }, k, source.extent_int(0), seen.low[c], seen.high[c],
           is_faulty);
      if (target.data() != source.data())
        look([this, c](const int i) { return target(i, c); }, k, target.extent_int(0), seen.low[c], seen.high[c],
             is_faulty);
    }
    seen.n_faulty += is_faulty ? 1 : 0;
    look([this](const int i) { return blob(i); }, k, blob.extent_int(0), seen.low[3], seen.high[3], is_faulty);
  }

  /// Widens a range by the k-th run of n numbers.
  template <class Number>
  KOKKOS_INLINE_FUNCTION static void look(const Number& number, const int k, const int n, double& least, double& most,
                                          bool& is_faulty) {
    const int first = k * run, end = math::smaller(n, first + run);
    double low[lanes], high[lanes], fault[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      low[lane] = least;
      high[lane] = most;
      fault[lane] = 0.0;
    }
    const auto take = [&](const int lane, const double value) {
      low[lane] = value < low[lane] ? value : low[lane];
      high[lane] = value > high[lane] ? value : high[lane];
      fault[lane] += value - value;
    };
    int i = first;
    for (; i + lanes <= end; i += lanes)
      for (int lane = 0; lane < lanes; ++lane) take(lane, number(i + lane));
    for (; i < end; ++i) take(0, number(i));
    for (int lane = 0; lane < lanes; ++lane) {
      least = low[lane] < least ? low[lane] : least;
      most = high[lane] > most ? high[lane] : most;
      is_faulty = is_faulty || !(fault[lane] == 0.0);
    }
  }
};

}  // namespace

template <class Space>
BlobRange find_blob_range(const Space& space, const ConstScalarView<Space>& blob) {
  return take_census<Space>(space, {}, {}, blob).blobs;
}

template <class Space>
NodeCensus take_census(const Space& space, const ConstVectorView<Space>& source, const ConstVectorView<Space>& target,
                       const ConstScalarView<Space>& blob) {
  using Look = LookAtNodes<Space>;
  Extremes seen;
  const int n = std::max({source.extent_int(0), target.extent_int(0), blob.extent_int(0)});
  launch_reduction<Space>("skein::take_census", space, Calls{math::ceil_div(n, Look::run), 2.5 * Look::run},
                          Look{source, target, blob}, JoinExtremes(seen));
  NodeCensus census{{}, {seen.low[3], seen.high[3]}, seen.n_faulty == 0};
  for (int c = 0; c < 3; ++c) {
    census.bounds.low[c] = seen.low[c];
    census.bounds.high[c] = seen.high[c];
  }
  return census;
}

#define SKEIN_INSTANTIATE(S)                                                                         \
  template BlobRange find_blob_range<S>(const S&, const ConstScalarView<S>&);                        \
  template NodeCensus take_census<S>(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&, \
                                     const ConstScalarView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
