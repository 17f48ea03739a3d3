#pragma once

namespace skein {

/// Lets waiting OpenMP threads sleep after half a millisecond instead of spinning for 15.
///
/// g++'s OpenMP library spins 300 000 times by default. With another busy program on the same cores a thread then waits
/// for a time slice that its partner spins away, at each of the thousands of joins of a second: a run on two cores was
/// measured six times slower beside one busy process. With 1000 turns in place of 10 000 it is twice as fast beside
/// busy processes, but some per cent slower on a free machine, which is what long runs are given (docs/performance.md).
/// The library reads its settings before main, so the program sets GOMP_SPINCOUNT and starts itself anew, once; a
/// user's GOMP_SPINCOUNT or OMP_WAIT_POLICY is left alone.
void limit_thread_spinning(char** argv);

/// Lets the system place the threads of the processes that this one is going to start side by side: with OMP_PROC_BIND
/// or GOMP_CPU_AFFINITY each would bind its first thread to the same processor. The program starts itself anew, once,
/// with the words that it was called with; to be called before anything is written.
void leave_threads_unbound();

}  // namespace skein
