#include <CppUTest/CommandLineTestRunner.h>
#include <CppUTest/MemoryLeakWarningPlugin.h>

int main(int count, char** arguments) {
  // CppUTest calls everything a leak that outlives its test, also the caches that RapidCheck and
  // the standard library keep for good. Leaks are AddressSanitizer's task (preset "asan"), and the
  // programs *_allocations count what a tick allocates.
  MemoryLeakWarningPlugin::turnOffNewDeleteOverloads();
  return CommandLineTestRunner::RunAllTests(count, arguments);
}
