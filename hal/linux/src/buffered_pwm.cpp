#include "supercoil/hal_linux/buffered_pwm.hpp"

#include <utility>

namespace supercoil::hal_linux {

BufferedPwm::BufferedPwm(std::unique_ptr<hal::PwmOutput> device)
    : device_(std::move(device)), steps_(device_->steps()) {}

hal::Status BufferedPwm::set(int step) {
  if (step < 0 || step > steps_) return hal::Status::out_of_range;
  const Written& last = results_.newest();
  unserved_ = last.number == seen_ && request_.number != seen_ ? unserved_ + 1 : 0;
  seen_ = last.number;
  request_ = {step, request_.number + 1};
  requests_.put(request_);
  return unserved_ >= max_unserved ? hal::Status::busy : last.status;
}

int BufferedPwm::read_back() const {
  const Written& last = results_.newest();
  const bool under_way = last.number != request_.number;
  return under_way || last.status != hal::Status::ok ? -1 : last.read_back;
}

void BufferedPwm::serve() {
  const Request& request = requests_.newest();
  if (request.number == written_.number && written_.status == hal::Status::ok) return;
  written_.number = request.number;
  written_.status = device_->set(request.step);
  written_.read_back = device_->read_back();
  results_.put(written_);
}

}  // namespace supercoil::hal_linux
