#include <skein/fmm/even_sample.hpp>

namespace skein {

template <class Space>
std::vector<Vec3> read_sample(const Space& space, const ConstVectorView<Space>& vectors, const EvenSample& sample) {
  const VectorView<Space> chosen("skein::even_sample::sample", sample.n_chosen);
  Kokkos::parallel_for(
      "skein::read_sample", Kokkos::RangePolicy<Space>(space, 0, sample.n_chosen),
      KOKKOS_LAMBDA(const int i) { store(chosen, i, load(vectors, sample.index(i))); });
  space.fence();
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), chosen);
  std::vector<Vec3> list;
  for (int i = 0; i < sample.n_chosen; ++i) list.push_back(load(host, i));
  return list;
}

#define SKEIN_INSTANTIATE(S) \
  template std::vector<Vec3> read_sample<S>(const S&, const ConstVectorView<S>&, const EvenSample&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
