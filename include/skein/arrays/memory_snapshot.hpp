#pragma once

#include <skein/arrays/memory_visitor.hpp>
#include <skein/arrays/node_vectors.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace skein {

/// What objects remember at one moment, to be brought back later. Arrays stay on the device, and where
/// ranks have parts of them, with these; their copies are used again by the next take.
class MemorySnapshot {
 public:
  /// Remembers what visit_memory of each object shows, in place of what was remembered before.
  template <class... Objects>
  void take(Objects&... objects) {
    Saver saver(*this);
    (objects.visit_memory(saver), ...);
  }

  /// Brings it back. @param objects  those of the last take, in its order
  template <class... Objects>
  void bring_back(Objects&... objects) const {
    Restorer restorer(*this);
    (objects.visit_memory(restorer), ...);
  }

 private:
  class Saver final : public MemoryVisitor {
   public:
    explicit Saver(MemorySnapshot& snapshot);
    void number(std::string_view name, double& value) override;
    void integer(std::string_view name, std::int64_t& value) override;
    void vectors(std::string_view name, const Vectors& values) override;
    void node_vectors(std::string_view name, NodeVectors& nodes, const Vectors& values) override;

   private:
    MemorySnapshot& snapshot_;
    std::size_t n_vectors_ = 0;
  };

  class Restorer final : public MemoryVisitor {
   public:
    explicit Restorer(const MemorySnapshot& snapshot) : snapshot_(snapshot) {}
    void number(std::string_view name, double& value) override;
    void integer(std::string_view name, std::int64_t& value) override;
    void vectors(std::string_view name, const Vectors& values) override;
    void node_vectors(std::string_view name, NodeVectors& nodes, const Vectors& values) override;
    bool changes_what_it_sees() const override { return true; }

   private:
    const MemorySnapshot& snapshot_;
    std::size_t n_numbers_ = 0, n_integers_ = 0, n_vectors_ = 0;
  };

  std::vector<double> numbers_;
  std::vector<std::int64_t> integers_;
  std::vector<Vectors> vectors_;
};

}  // namespace skein
