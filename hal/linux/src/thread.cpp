#include "supercoil/hal_linux/thread.hpp"

#include <utility>

namespace supercoil::hal_linux {

Result<Thread> Thread::start(const ThreadSettings& settings, std::function<void()> body) {
  auto running = std::make_unique<Running>(Running{std::move(body), {}});
  pthread_attr_t attributes{};
  ::pthread_attr_init(&attributes);
  int error = ::pthread_attr_setstacksize(&attributes, settings.stack_bytes);
  if (error == 0) {
    error = ::pthread_create(
        &running->id, &attributes,
        [](void* argument) -> void* {
          static_cast<Running*>(argument)->body();
          return nullptr;
        },
        running.get());
  }
  ::pthread_attr_destroy(&attributes);
  if (error != 0) {
    return failed_call("cannot start the thread '" + settings.name + "' with " +
                           std::to_string(settings.stack_bytes) + " bytes of stack",
                       error);
  }
  constexpr std::size_t max_name = 15;
  Thread thread(std::move(running));
  const pthread_t id = thread.running_->id;
  ::pthread_setname_np(id, settings.name.substr(0, max_name).c_str());
  if (settings.priority > 0) thread.steps_.push_back(set_fifo_priority(id, settings.priority));
  if (settings.cpu >= 0) thread.steps_.push_back(pin_to_cpu(id, settings.cpu));
  return thread;
}

Thread::~Thread() {
  if (running_) ::pthread_join(running_->id, nullptr);
}

}  // namespace supercoil::hal_linux
