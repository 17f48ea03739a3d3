#pragma once

namespace skein {

/// Lets waiting OpenMP threads sleep after half a millisecond instead of spinning for 15.
///
/// g++'s OpenMP library spins 300 000 times by default. With another busy program on the same cores a thread then waits
/// for a time slice that its partner spins away, at each of the thousands of joins of a second: a run on two cores was
/// measured six times slower beside one busy process, with no gain on a free machine. The library reads its settings
/// before main, so the program sets GOMP_SPINCOUNT and starts itself anew, once; a user's GOMP_SPINCOUNT or
/// OMP_WAIT_POLICY is left alone.
void limit_thread_spinning(char** argv);

}  // namespace skein
