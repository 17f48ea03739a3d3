#pragma once

#include <skein/arrays/combination.hpp>
#include <skein/arrays/types.hpp>

#include <initializer_list>
#include <string>

namespace skein {

/// The arrays of vectors on nodes that an integrator works with, and all that it does with them. Here an array is the
/// whole of it. Where ranks own nodes each of them has a part of every array: rank 0 works with its own parts, and what
/// it does with them is done by the others with theirs. No bit depends on it.
class NodeVectors {
 public:
  virtual ~NodeVectors() = default;

  /// Zeros on all nodes. Arrays that functions below are given were made here, unless they are said to be whole.
  /// @param label  of the array  @param n_nodes  all of them  @returns [n_nodes, 3], or the part of it that is here
  virtual Vectors make(const std::string& label, int n_nodes);
  virtual Vectors make_like(const std::string& label, const Vectors& vectors);

  /// result = the sum of two, four or five terms, in their order. `result` may be one of them.
  virtual void combine(const Vectors& result, std::initializer_list<Term<ExecSpace>> terms);
  virtual void copy(const Vectors& to, const ConstVectors& from);
  virtual void set_to_zero(const Vectors& vectors);

  /// Over all nodes, in the order of skein::dot_product. They wait for the device.
  virtual double dot_product(const ConstVectors& a, const ConstVectors& b);
  virtual double root_mean_square(const ConstVectors& vectors);

  /// The whole of an array, not to be changed: it may be the array itself, or serve later calls.
  /// Where ranks own nodes it is not asked for again as long as nothing changes the array.
  virtual Vectors gather(const Vectors& vectors);
  /// The same, to be read.
  virtual ConstVectors gather_whole(const ConstVectors& vectors);

  /// Overwrites an array. @param whole  [n_nodes, 3]
  virtual void scatter(const ConstVectors& whole, const Vectors& vectors);

  /// Room for the whole of an array, to be scattered: the array itself, or another.
  virtual Vectors make_room_for_whole(const Vectors& vectors);
};

/// Those of one process, for all.
NodeVectors& whole_vectors();

}  // namespace skein
