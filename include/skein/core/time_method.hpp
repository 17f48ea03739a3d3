#pragma once

namespace skein {

/// The methods that advance time. `automatic` stands for whichever of rkc2 and trbdf2 is expected to do with less work.
enum class TimeMethod { automatic, rkc2, trbdf2, rk4, bs3, euler };

}  // namespace skein
