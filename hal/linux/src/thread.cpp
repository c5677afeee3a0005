#include "supercoil/hal_linux/thread.hpp"

#include <utility>

namespace supercoil::hal_linux {

Result<Thread> Thread::start(const ThreadWish& wish, std::function<void()> body) {
  auto running = std::make_unique<Running>(Running{std::move(body), {}});
  pthread_attr_t attributes{};
  ::pthread_attr_init(&attributes);
  int error = ::pthread_attr_setstacksize(&attributes, wish.stack_bytes);
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
    return problem("cannot start the thread '" + wish.name + "' with " +
                       std::to_string(wish.stack_bytes) + " bytes of stack",
                   error);
  }
  constexpr std::size_t longest_name = 15;
  Thread thread(std::move(running));
  const pthread_t id = thread.running_->id;
  ::pthread_setname_np(id, wish.name.substr(0, longest_name).c_str());
  if (wish.priority > 0) thread.steps_.push_back(set_fifo_priority(id, wish.priority));
  if (wish.cpu >= 0) thread.steps_.push_back(pin_to_cpu(id, wish.cpu));
  return thread;
}

Thread::~Thread() {
  if (running_) ::pthread_join(running_->id, nullptr);
}

}  // namespace supercoil::hal_linux
