#include "runs/checkpoint_memory.hpp"

#include <skein/core/error.hpp>

#include <fmt/format.h>

namespace skein {

void MemorySaver::number(const std::string_view name, double& value) {
  checkpoint_.set(std::string(name), std::vector<double>{value});
}

void MemorySaver::integer(const std::string_view name, std::int64_t& value) {
  checkpoint_.set(std::string(name), std::vector<std::int64_t>{value});
}

void MemorySaver::vectors(const std::string_view name, const Vectors& values) {
  std::vector<double> numbers;
  numbers.reserve(3 * values.extent(0));
  for (const Vec3& v : to_host(ConstVectors(values))) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  checkpoint_.set(std::string(name), std::move(numbers));
}

void MemoryRestorer::number(const std::string_view name, double& value) {
  value = checkpoint_.number(std::string(name));
}

void MemoryRestorer::integer(const std::string_view name, std::int64_t& value) {
  value = checkpoint_.integer(std::string(name));
}

void MemoryRestorer::vectors(const std::string_view name, const Vectors& values) {
  const std::vector<double>& numbers = checkpoint_.numbers(std::string(name));
  if (numbers.size() != 3 * values.extent(0))
    throw Error(ExitCode::damaged_data, fmt::format("the checkpoint's '{}' has {} numbers, the scene's nodes need {}",
                                                    name, numbers.size(), 3 * values.extent(0)));
  std::vector<Vec3> host;
  host.reserve(values.extent(0));
  for (std::size_t i = 0; i < numbers.size(); i += 3) host.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  Kokkos::deep_copy(values, to_device("skein::MemoryRestorer", host));
}

void visit_memory(MemoryVisitor& visitor, State& state) {
  visitor.number("state.time", state.time);
  visitor.integer("state.step", state.step);
  visitor.vectors("state.position", state.position);
}

}  // namespace skein
