#pragma once

namespace skein {

/// Makes sure that threads have stacks as large as the loops need, and that the system starts that many: tried, for a
/// moment, as the OpenMP library will do it.
/// @throws Error(usage), naming the variable or limit that makes stacks too small; ResourceError if a thread is
///         refused
void check_thread_stacks(int n_threads);

}  // namespace skein
