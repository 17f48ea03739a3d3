#pragma once

namespace skein {

/// Lets waiting OpenMP threads sleep after some 50 microseconds instead of spinning for 15 milliseconds.
///
/// g++'s OpenMP library spins 300 000 times by default. With another busy program on the same cores a thread then waits
/// for a time slice that its partner spins away, at each of the thousands of joins of a second. 10 000 turns were
/// measured 7 to 11 times slower than 1000 beside busy processes, and no faster on a free machine but between 300 and
/// 500 nodes; 100 turns are too few there (docs/performance.md). The library reads its settings
/// before main, so the program sets GOMP_SPINCOUNT and starts itself anew, once; a user's GOMP_SPINCOUNT or
/// OMP_WAIT_POLICY is left alone.
void limit_thread_spinning(char** argv);

/// Lets the system place the threads of the processes that this one is going to start side by side: with OMP_PROC_BIND
/// or GOMP_CPU_AFFINITY each would bind its first thread to the same processor. The program starts itself anew, once,
/// with the words that it was called with; to be called before anything is written.
void leave_threads_unbound();

}  // namespace skein
