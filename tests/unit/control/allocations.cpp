// Counts what the control library allocates while it steps: nothing is allowed to.
//
// A program of its own, because CppUTest owns operator new. Eigen's own check
// (EIGEN_RUNTIME_NO_MALLOC) works only with assertions on, so malloc itself is replaced: everything
// that allocates ends there.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "supercoil/control/estimation/estimator.hpp"

#include "unit/control/support/muscle.hpp"

namespace {
// Plain counters: this program has one thread.
long heap_calls = 0;
long new_calls = 0;
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
  ++heap_calls;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++heap_calls;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++heap_calls;
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++heap_calls;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  *result = memalign(alignment, size);
  return *result == nullptr ? ENOMEM : 0;
}
}

void* operator new(std::size_t size) {
  ++new_calls;
  if (void* result = __libc_malloc(size)) return result;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++new_calls;
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

namespace {

using namespace supercoil::control;

constexpr int steps = 100'000;
constexpr double step_s = 1e-3;
int failures = 0;

template <class Work>
std::pair<long, long> counted(Work work) {
  const long heap_before = heap_calls;
  const long new_before = new_calls;
  work();
  return {heap_calls - heap_before, new_calls - new_before};
}

/// A pointer that the compiler must believe is used, so that it cannot drop the allocation.
void keep(void* memory) {
  asm volatile("" : : "g"(memory) : "memory");
}

void expect_seen(const char* what, std::pair<long, long> seen, bool by_new) {
  const bool right = (by_new ? seen.second : seen.first) == 1;
  std::printf("counter sees %-15s %s\n", what, right ? "yes" : "NO");
  if (!right) ++failures;
}

/// A counter that sees nothing would pass every test: it first has to see each kind.
void prove_the_counter() {
  expect_seen("malloc", counted([] {
                void* m = std::malloc(100);
                keep(m);
                std::free(m);
              }),
              false);
  expect_seen("calloc", counted([] {
                void* m = std::calloc(5, 20);
                keep(m);
                std::free(m);
              }),
              false);
  expect_seen("aligned_alloc", counted([] {
                void* m = std::aligned_alloc(64, 128);
                keep(m);
                std::free(m);
              }),
              false);
  void* block = std::malloc(10);
  expect_seen("realloc", counted([&] {
                block = std::realloc(block, 5000);
                keep(block);
              }),
              false);
  std::free(block);
  expect_seen("new", counted([] {
                auto p = std::make_unique<double>(1.0);
                keep(p.get());
              }),
              true);
  expect_seen("Eigen's resize", counted([] {
                Eigen::VectorXd v(50);
                keep(v.data());
              }),
              false);
}

void expect_none(const char* what, std::string_view arithmetic, std::pair<long, long> seen) {
  std::printf("%-9s %-7.*s malloc %ld, new %ld in %d steps\n", what,
              static_cast<int>(arithmetic.size()), arithmetic.data(), seen.first, seen.second,
              steps);
  if (seen.first != 0 || seen.second != 0) ++failures;
}

void check_controllers() {
  for (const auto& [kind_name, kind] : controller_names) {
    for (const auto& [arithmetic_name, arithmetic] : arithmetic_names) {
      ControllerSettings settings;
      settings.kind = kind;
      settings.arithmetic = arithmetic;
      settings.mrac = MracSettings{}.scaled(10.0);
      // Every option on, so that every branch runs.
      settings.mrac.bounds = Box<double, 6>{MracSettings::Parameters::Constant(-50.0),
                                            MracSettings::Parameters::Constant(50.0)};
      settings.mrac.sigma_modification = 1e-4;
      settings.mrac.dead_zone_W = 1e-4;
      Controller controller(settings, step_s);
      expect_none(kind_name.data(), arithmetic_name, counted([&] {
                    supercoil::test::run_closed_loop(controller, step_s, steps * step_s,
                                                     PowerRange{}, supercoil::test::paper_sine_m,
                                                     [](const supercoil::test::Tick&) {});
                  }));
    }
  }
}

void check_estimators() {
  for (const auto& [kind_name, kind] : estimator_names) {
    for (const auto& [arithmetic_name, arithmetic] : arithmetic_names) {
      EstimatorSettings settings;
      settings.kind = kind;
      settings.arithmetic = arithmetic;
      settings.gradient.normalisation = 0.5;
      settings.gradient.bounds =
          Box<double, 4>{Theta{0.1, 1.0, 10.0, 10.0}, Theta{60.0, 120.0, 1000.0, 500.0}};
      Estimator estimator(settings, step_s);
      supercoil::test::Muscle muscle(PhysicalParameters{}, step_s);
      expect_none(kind_name.data(), arithmetic_name, counted([&] {
                    for (int k = 0; k < steps; ++k) {
                      const double power_W = supercoil::test::paper_power_W(step_s * k);
                      muscle.step(power_W);
                      estimator.step(muscle.position_m(), power_W);
                      auto estimate = estimator.estimate();
                      keep(&estimate);
                    }
                  }));
    }
  }
}

}  // namespace

int main() {
  prove_the_counter();
  check_controllers();
  check_estimators();
  std::printf(failures == 0 ? "no allocation in any step\n" : "%d FAILED\n", failures);
  return failures == 0 ? 0 : 1;
}
