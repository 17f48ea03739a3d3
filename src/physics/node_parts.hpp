#pragma once

#include <skein/arrays/types.hpp>
#include <skein/physics/sections.hpp>
#include <skein/ranks/communicator.hpp>

#include "needed_rows.hpp"
#include "sum_order.hpp"

#include <string>
#include <unordered_map>

namespace skein {

/// A rank's own part of an array on nodes. It has a row at least, so that it is told from others by where it lies: one
/// that is nobody's where the rank owns no nodes.
Vectors make_part(const std::string& label, const RankParts& owners, int rank);
/// Those that it owns. @param part  as make_part makes it
Vectors own_rows(const Vectors& part, const RankParts& owners, int rank);
Vectors rows_of(const Vectors& whole, std::size_t first, std::size_t n);

/// How a communicator reaches rows of an array: where they are, or by copies on the host of what is sent and received,
/// as a device needs it of one that knows the host's memory alone. No bit depends on it.
enum class RowAccess { as_needed, in_place, by_copies };

/// To be called by all ranks: each has its own rows of an array, and all rows afterwards. @param whole [owners.total(),
/// 3]
void gather_rows_to_all(Communicator& ranks, const RankParts& owners, const Vectors& whole,
                        RowAccess access = RowAccess::as_needed);

/// To be called by all ranks. The parts of an array on all ranks, or on rank 0 alone, or from rank 0.
/// @param whole  [owners.total(), 3]; of rank 0 alone in the latter two
void gather_parts_to_all(Communicator& ranks, const RankParts& owners, const Vectors& part, const Vectors& whole,
                         RowAccess access = RowAccess::as_needed);
void gather_parts(Communicator& ranks, const RankParts& owners, const Vectors& part, const Vectors& whole,
                  RowAccess access = RowAccess::as_needed);
void scatter_parts(Communicator& ranks, const RankParts& owners, const Vectors& whole, const Vectors& part,
                   RowAccess access = RowAccess::as_needed);

/// The same of the rows that each rank needs, its own included. @param needed  not all  @param whole  [owners.total(),
/// 3], of which other rows stay as they are
void gather_needed_rows(Communicator& ranks, const RankParts& owners, const NeededRows& needed, const Vectors& part,
                        const Vectors& whole, RowAccess access = RowAccess::as_needed);

/// The same of the means of a vector over all sections' nodes. @param owned  sections, of each rank
/// @param vector  [n_nodes, 3], of which this rank has its own rows  @returns [n_sections, 3]
Vectors gather_means(Communicator& ranks, const RankParts& owners, const RankParts& owned, const Sections& sections,
                     const Vectors& vector, RowAccess access = RowAccess::as_needed);

/// Of an array whose parts ranks have, what the forces on their own nodes need of it: in `whole` all rows, or of a
/// local one the rows that are needed. @returns means over sections, where forces see those and `whole` has not all;
/// else none
Vectors gather_for_forces(Communicator& ranks, const RankParts& owners, const NeededRows& needed,
                          const Sections& sections, bool is_local, const Vectors& part, const Vectors& whole);

/// The same of two arrays' dot product: with the bits of dot_product of the whole arrays.
/// @returns it on rank 0, 0 on others
double add_up_products(Communicator& ranks, const RankParts& owners, const Vectors& part, const Vectors& other,
                       RowAccess access = RowAccess::as_needed);

/// The parts of arrays that a rank other than 0 has, by the numbers that rank 0 gave them.
class NodeParts {
 public:
  NodeParts(const RankParts& owners, const int rank) : owners_(owners), rank_(rank) {}
  const RankParts& owners() const { return owners_; }
  const Vectors& operator[](const int number) const { return parts_.at(number); }
  Vectors rows(const int number) const { return own_rows(parts_.at(number), owners_, rank_); }

  /// All kinds of work but add_fmm_sum.
  void work(const PartWork& work);

 private:
  RankParts owners_;
  int rank_;
  std::unordered_map<int, Vectors> parts_;
};

}  // namespace skein
