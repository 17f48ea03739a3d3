#pragma once

#include <functional>

namespace skein {

/// Kokkos allows one thread to begin, use and end it; Python has many. So one thread of the module's own does all that
/// needs Kokkos, in the order in which it is asked, and begins when it is asked first.

/// Host threads for Kokkos. @throws Error(usage) when it has begun
void set_device_threads(int threads);

/// Does the work on that thread and waits; at once if this is that thread. Python's lock must not be held, as the work
/// may ask for it. What the work throws is thrown here.
/// @throws Error(usage) in a process that was forked from one in which Kokkos has begun; what Runtime throws
void run_on_device_thread(const std::function<void()>& work);

/// Lets that thread do the work some time: for what must be given back there. Dropped where there is no such thread.
void leave_to_device_thread(std::function<void()> work);

/// Ends Kokkos, after all work that was asked for.
void end_device_thread();

}  // namespace skein
