#include <skein/arrays/combination.hpp>
#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include <utility>

namespace skein {
namespace {

template <class Space, int n_terms>
struct Combination {
  double factor[n_terms];
  ConstVectorView<Space> vectors[n_terms];
  VectorView<Space> result;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int c = 0; c < 3; ++c) {
      double sum = factor[0] * vectors[0](i, c);
      for (int term = 1; term < n_terms; ++term) sum += factor[term] * vectors[term](i, c);
      result(i, c) = sum;
    }
  }
};

/// Sums of chunks, kept from one dot product to the next: on a device an allocation takes longer than the product, and
/// waits for all that was launched. Freed before Kokkos ends.
template <class Space>
const ScalarView<Space>& require_chunk_sums(const int n_chunks) {
  static ScalarView<Space> sums;
  if (sums.extent_int(0) < n_chunks) {
    if (!sums.is_allocated()) Kokkos::push_finalize_hook([] { sums = {}; });
    sums = ScalarView<Space>(Kokkos::ViewAllocateWithoutInitializing("skein::dot_product"), n_chunks);
  }
  return sums;
}

template <class Space, class... Terms>
void run(const Space& space, const VectorView<Space>& result, const Terms&... terms) {
  SKEIN_REQUIRE(((terms.vectors.extent(0) == result.extent(0)) && ...), "arrays of a combination differ in length");
  launch<Space>("skein::combine", space, Calls{result.extent_int(0), 10.0},
                Combination<Space, sizeof...(Terms)>{{terms.factor...}, {terms.vectors...}, result});
}

}  // namespace

template <class Space>
void combine(const Space& space, const VectorView<Space>& result, const Term<Space>& a, const Term<Space>& b) {
  run<Space>(space, result, a, b);
}
template <class Space>
void combine(const Space& space, const VectorView<Space>& result, const Term<Space>& a, const Term<Space>& b,
             const Term<Space>& c, const Term<Space>& d) {
  run<Space>(space, result, a, b, c, d);
}
template <class Space>
void combine(const Space& space, const VectorView<Space>& result, const Term<Space>& a, const Term<Space>& b,
             const Term<Space>& c, const Term<Space>& d, const Term<Space>& e) {
  run<Space>(space, result, a, b, c, d, e);
}

// A device has threads in plenty, and the host adds up what they leave.
template <class Space>
int choose_dot_chunk(const int n_nodes) {
  constexpr int most_nodes = 256, fewest_nodes = 16, most_chunks = 4096;
  if (on_host<Space>) return most_nodes;
  return math::smaller(most_nodes, math::larger(fewest_nodes, math::ceil_div(n_nodes, most_chunks)));
}

template <class Space>
std::vector<double> dot_chunks(const Space& space, const ConstVectorView<Space>& a, const ConstVectorView<Space>& b,
                               const int chunk_nodes) {
  SKEIN_REQUIRE(a.extent(0) == b.extent(0), "arrays of a dot product differ in length");
  const int n_nodes = a.extent_int(0);
  const int n_chunks = math::ceil_div(n_nodes, chunk_nodes);
  const ScalarView<Space> chunk_sum = require_chunk_sums<Space>(n_chunks);
  launch<Space>(
      "skein::dot_product", space, Calls{n_chunks, 1.0 * chunk_nodes}, KOKKOS_LAMBDA(const int chunk) {
        const int last = math::smaller(n_nodes, (chunk + 1) * chunk_nodes);
        double sum = 0.0;
        for (int i = chunk * chunk_nodes; i < last; ++i)
          sum += a(i, 0) * b(i, 0) + a(i, 1) * b(i, 1) + a(i, 2) * b(i, 2);
        chunk_sum(chunk) = sum;
      });
  const auto on_host =
      Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), Kokkos::subview(chunk_sum, std::make_pair(0, n_chunks)));
  return std::vector<double>(on_host.data(), on_host.data() + n_chunks);
}

template <class Space>
double dot_product(const Space& space, const ConstVectorView<Space>& a, const ConstVectorView<Space>& b) {
  double total = 0.0;
  for (const double of_chunk : dot_chunks<Space>(space, a, b, choose_dot_chunk<Space>(a.extent_int(0))))
    total += of_chunk;
  return total;
}

#define SKEIN_INSTANTIATE(S)                                                                                       \
  template void combine<S>(const S&, const VectorView<S>&, const Term<S>&, const Term<S>&);                        \
  template void combine<S>(const S&, const VectorView<S>&, const Term<S>&, const Term<S>&, const Term<S>&,         \
                           const Term<S>&);                                                                        \
  template void combine<S>(const S&, const VectorView<S>&, const Term<S>&, const Term<S>&, const Term<S>&,         \
                           const Term<S>&, const Term<S>&);                                                        \
  template int choose_dot_chunk<S>(int);                                                                           \
  template std::vector<double> dot_chunks<S>(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&, int); \
  template double dot_product<S>(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
