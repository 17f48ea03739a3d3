#pragma once

namespace skein {

/// Of what is summed pair by pair.
enum class Precision { in_double, in_single };

}  // namespace skein
