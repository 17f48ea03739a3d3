#pragma once

#include <skein/arrays/memory_visitor.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/solvers/integrator.hpp>

namespace skein {

/// Puts what it sees into a checkpoint.
class MemorySaver final : public MemoryVisitor {
 public:
  explicit MemorySaver(Checkpoint& checkpoint) : checkpoint_(checkpoint) {}
  void number(std::string_view name, double& value) override;
  void integer(std::string_view name, std::int64_t& value) override;
  void vectors(std::string_view name, const Vectors& values) override;

 private:
  Checkpoint& checkpoint_;
};

/// Brings it back. @throws Error(damaged_data) if something is absent or of another size
class MemoryRestorer final : public MemoryVisitor {
 public:
  explicit MemoryRestorer(const Checkpoint& checkpoint) : checkpoint_(checkpoint) {}
  void number(std::string_view name, double& value) override;
  void integer(std::string_view name, std::int64_t& value) override;
  void vectors(std::string_view name, const Vectors& values) override;

 private:
  const Checkpoint& checkpoint_;
};

void visit_memory(MemoryVisitor& visitor, State& state);

}  // namespace skein
