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

/// Counts the bytes that a checkpoint of it takes.
class MemorySize final : public MemoryVisitor {
 public:
  void number(std::string_view name, double&) override { add(name, 1); }
  void integer(std::string_view name, std::int64_t&) override { add(name, 1); }
  void vectors(std::string_view name, const Vectors& values) override { add(name, 3 * values.extent(0)); }

  std::size_t bytes() const { return bytes_; }

 private:
  void add(std::string_view name, std::size_t n_numbers) { bytes_ += 16 + (name.size() + 7) / 8 * 8 + 8 * n_numbers; }

  std::size_t bytes_ = 0;
};

/// Brings it back. @throws Error(damaged_data) if something is absent or of another size
class MemoryRestorer final : public MemoryVisitor {
 public:
  explicit MemoryRestorer(const Checkpoint& checkpoint) : checkpoint_(checkpoint) {}
  void number(std::string_view name, double& value) override;
  void integer(std::string_view name, std::int64_t& value) override;
  void vectors(std::string_view name, const Vectors& values) override;
  bool changes_what_it_sees() const override { return true; }

 private:
  const Checkpoint& checkpoint_;
};

void visit_memory(MemoryVisitor& visitor, State& state);

}  // namespace skein
