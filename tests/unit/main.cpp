#include <CppUTest/CommandLineTestRunner.h>
#include <CppUTest/MemoryLeakWarningPlugin.h>

int main(int count, char** arguments) {
  // CppUTest treats everything that outlives its test as a leak, including caches that RapidCheck
  // and the standard library keep for good. AddressSanitizer detects leaks (preset "asan"), and the
  // programs *_allocations count what a tick allocates.
  MemoryLeakWarningPlugin::turnOffNewDeleteOverloads();
  return CommandLineTestRunner::RunAllTests(count, arguments);
}
