#pragma once

#include <skein/core/error.hpp>

#include <string>

namespace skein {

/// Another rank is lost, or cannot go on: what this one holds is whole.
class RankError : public Error {
 public:
  using Error::Error;
};

}  // namespace skein
