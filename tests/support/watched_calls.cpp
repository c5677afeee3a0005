#include "support/watched_calls.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <Eigen/Core>

namespace {

thread_local supercoil::test::WatchedCalls calls;

/// The original of the function that ours replaces.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
  ++calls.heap;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++calls.heap;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++calls.heap;
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++calls.heap;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  *result = memalign(alignment, size);
  return *result == nullptr ? ENOMEM : 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  ++calls.locks;
  static auto* const real = next<int(pthread_mutex_t*)>("pthread_mutex_lock");
  return real(mutex);
}
ssize_t write(int file, const void* data, std::size_t size) {
  ++calls.files;
  static auto* const real = next<ssize_t(int, const void*, std::size_t)>("write");
  return real(file, data, size);
}
std::size_t fwrite(const void* data, std::size_t size, std::size_t count, FILE* file) {
  ++calls.files;
  static auto* const real =
      next<std::size_t(const void*, std::size_t, std::size_t, FILE*)>("fwrite");
  return real(data, size, count, file);
}
FILE* fopen(const char* path, const char* mode) {
  ++calls.files;
  static auto* const real = next<FILE*(const char*, const char*)>("fopen");
  return real(path, mode);
}
[[noreturn]] void __cxa_throw(void* object, void* type, void (*destructor)(void*)) {
  ++calls.throws;
  static auto* const real = next<void(void*, void*, void (*)(void*))>("__cxa_throw");
  real(object, type, destructor);
  std::abort();
}
}

void* operator new(std::size_t size) {
  ++calls.news;
  if (void* result = __libc_malloc(size)) return result;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++calls.news;
  if (void* result = __libc_memalign(static_cast<std::size_t>(alignment), size)) return result;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  __libc_free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  __libc_free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  __libc_free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  __libc_free(memory);
}

namespace supercoil::test {

const WatchedCalls& watched_calls() {
  return calls;
}

int prove_the_counters() {
  int missed = 0;
  const auto expect = [&](const char* what, long WatchedCalls::*kind, auto work) {
    const bool seen = counted(work).*kind == 1;
    std::printf("counter sees %-15s %s\n", what, seen ? "yes" : "NO");
    missed += seen ? 0 : 1;
  };
  const auto freed = [](void* memory) {
    keep(memory);
    std::free(memory);
  };
  expect("malloc", &WatchedCalls::heap, [&] { freed(std::malloc(100)); });
  expect("calloc", &WatchedCalls::heap, [&] { freed(std::calloc(5, 20)); });
  expect("aligned_alloc", &WatchedCalls::heap, [&] { freed(std::aligned_alloc(64, 128)); });
  void* block = std::malloc(10);
  expect("realloc", &WatchedCalls::heap, [&] {
    block = std::realloc(block, 5000);
    keep(block);
  });
  std::free(block);
  expect("new", &WatchedCalls::news, [] {
    auto p = std::make_unique<double>(1.0);
    keep(p.get());
  });
  expect("Eigen's resize", &WatchedCalls::heap, [] {
    Eigen::VectorXd v(50);
    keep(v.data());
  });
  std::mutex mutex;
  expect("a mutex", &WatchedCalls::locks, [&] { const std::lock_guard lock(mutex); });
  FILE* opened = nullptr;
  expect("fopen", &WatchedCalls::files, [&] { opened = std::fopen("/dev/null", "w"); });
  if (opened != nullptr) std::fclose(opened);
  const int null = open("/dev/null", O_WRONLY);
  expect("write", &WatchedCalls::files, [&] { keep(&missed), (void)!write(null, "x", 1); });
  close(null);
  expect("an exception", &WatchedCalls::throws, [] {
    try {
      throw std::runtime_error("seen");
    } catch (const std::runtime_error&) {
    }
  });
  return missed;
}

}  // namespace supercoil::test
