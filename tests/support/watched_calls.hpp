// Counts calls that a real-time step must not make.
//
// For programs of their own: CppUTest owns operator new, sanitizers own malloc. Eigen's own check
// (EIGEN_RUNTIME_NO_MALLOC) works only with assertions on, so malloc itself is replaced: everything
// that allocates ends there.
#pragma once

namespace supercoil::test {

struct WatchedCalls {
  long heap = 0;    ///< malloc, calloc, realloc, aligned_alloc, posix_memalign
  long news = 0;    ///< operator new
  long locks = 0;   ///< pthread mutexes
  long files = 0;   ///< fopen, fwrite, write
  long throws = 0;  ///< exceptions

  long all() const { return heap + news + locks + files + throws; }
  WatchedCalls& operator+=(const WatchedCalls& other) {
    heap += other.heap;
    news += other.news;
    locks += other.locks;
    files += other.files;
    throws += other.throws;
    return *this;
  }
};

/// Of the calling thread, since it started.
const WatchedCalls& watched_calls();

template <class Work>
WatchedCalls counted(Work work) {
  const WatchedCalls before = watched_calls();
  work();
  const WatchedCalls now = watched_calls();
  return {now.heap - before.heap, now.news - before.news, now.locks - before.locks,
          now.files - before.files, now.throws - before.throws};
}

/// A pointer that the compiler must believe is used, so that it cannot drop the allocation.
inline void keep(void* memory) {
  asm volatile("" : : "g"(memory) : "memory");
}

/// A counter that sees nothing would pass every test, so it first has to see one call of each kind.
/// Prints what it saw; returns how many kinds it missed.
int prove_the_counters();

}  // namespace supercoil::test
