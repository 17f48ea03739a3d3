#include <skein/arrays/memory_snapshot.hpp>

namespace skein {

MemorySnapshot::Saver::Saver(MemorySnapshot& snapshot) : snapshot_(snapshot) {
  snapshot_.numbers_.clear();
  snapshot_.integers_.clear();
}

void MemorySnapshot::Saver::number(std::string_view /*name*/, double& value) { snapshot_.numbers_.push_back(value); }

void MemorySnapshot::Saver::integer(std::string_view /*name*/, std::int64_t& value) {
  snapshot_.integers_.push_back(value);
}

void MemorySnapshot::Saver::vectors(const std::string_view name, const Vectors& values) {
  node_vectors(name, whole_vectors(), values);
}

void MemorySnapshot::Saver::node_vectors(std::string_view /*name*/, NodeVectors& nodes, const Vectors& values) {
  if (n_vectors_ == snapshot_.vectors_.size()) snapshot_.vectors_.emplace_back();
  Vectors& copy = snapshot_.vectors_[n_vectors_++];
  if (copy.extent(0) != values.extent(0)) copy = nodes.make_like("skein::MemorySnapshot", values);
  nodes.copy(copy, values);
}

void MemorySnapshot::Restorer::number(std::string_view /*name*/, double& value) {
  value = snapshot_.numbers_.at(n_numbers_++);
}

void MemorySnapshot::Restorer::integer(std::string_view /*name*/, std::int64_t& value) {
  value = snapshot_.integers_.at(n_integers_++);
}

void MemorySnapshot::Restorer::vectors(const std::string_view name, const Vectors& values) {
  node_vectors(name, whole_vectors(), values);
}

void MemorySnapshot::Restorer::node_vectors(std::string_view /*name*/, NodeVectors& nodes, const Vectors& values) {
  nodes.copy(values, snapshot_.vectors_.at(n_vectors_++));
}

}  // namespace skein
