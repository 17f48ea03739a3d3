#include <skein/arrays/memory_visitor.hpp>
#include <skein/arrays/node_vectors.hpp>
#include <skein/core/error.hpp>

namespace skein {

Vectors NodeVectors::make(const std::string& label, const int n_nodes) {
  return Vectors(label, static_cast<std::size_t>(n_nodes));
}

Vectors NodeVectors::make_like(const std::string& label, const Vectors& vectors) {
  return Vectors(label, vectors.extent(0));
}

void NodeVectors::combine(const Vectors& result, const std::initializer_list<Term<ExecSpace>> terms) {
  const Term<ExecSpace>* const t = terms.begin();
  switch (terms.size()) {
    case 2:
      return skein::combine<ExecSpace>(ExecSpace(), result, t[0], t[1]);
    case 4:
      return skein::combine<ExecSpace>(ExecSpace(), result, t[0], t[1], t[2], t[3]);
    case 5:
      return skein::combine<ExecSpace>(ExecSpace(), result, t[0], t[1], t[2], t[3], t[4]);
  }
  throw Error(ExitCode::internal, "combinations have two, four or five terms");
}

void NodeVectors::copy(const Vectors& to, const ConstVectors& from) { Kokkos::deep_copy(ExecSpace(), to, from); }

void NodeVectors::set_to_zero(const Vectors& vectors) { Kokkos::deep_copy(ExecSpace(), vectors, 0.0); }

double NodeVectors::dot_product(const ConstVectors& a, const ConstVectors& b) {
  return skein::dot_product<ExecSpace>(ExecSpace(), a, b);
}

double NodeVectors::root_mean_square(const ConstVectors& vectors) {
  return skein::root_mean_square<ExecSpace>(ExecSpace(), vectors);
}

Vectors NodeVectors::gather(const Vectors& vectors) { return vectors; }

ConstVectors NodeVectors::gather_whole(const ConstVectors& vectors) { return vectors; }

void NodeVectors::scatter(const ConstVectors& whole, const Vectors& vectors) {
  if (whole.data() != vectors.data()) Kokkos::deep_copy(ExecSpace(), vectors, whole);
}

Vectors NodeVectors::make_room_for_whole(const Vectors& vectors) { return vectors; }

NodeVectors& whole_vectors() {
  static NodeVectors whole;
  return whole;
}

void MemoryVisitor::node_vectors(const std::string_view name, NodeVectors& nodes, const Vectors& values) {
  if (!changes_what_it_sees()) return vectors(name, nodes.gather(values));
  const Vectors whole = nodes.make_room_for_whole(values);
  vectors(name, whole);
  nodes.scatter(whole, values);
}

}  // namespace skein
