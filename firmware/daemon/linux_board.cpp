#include "daemon/linux_board.hpp"

#include <algorithm>

#include "supercoil/hal_linux/buffered_adc.hpp"
#include "supercoil/hal_linux/buffered_pwm.hpp"
#include "supercoil/hal_linux/iio_adc.hpp"
#include "supercoil/hal_linux/sysfs_pwm.hpp"

#include "daemon/log.hpp"

namespace supercoil::daemon {

namespace {

hal_linux::LineName line_name(const config::LineAddress& address) {
  return {address.chip, address.line};
}

}  // namespace

/// Opens one device after the other and notes those that cannot be had.
class LinuxBoard::Opening {
 public:
  explicit Opening(LinuxBoard& board) : board_(&board) {}

  template <class Wanted, class Opened>
  void take(const std::string& what, std::unique_ptr<Wanted>& into,
            hal_linux::Result<std::unique_ptr<Opened>> opened) {
    if (opened) {
      into = std::move(*opened);
    } else {
      problems_.push_back(what + ": " + opened.error().text);
    }
  }
  void output(const std::string& what, const config::LineAddress& address,
              std::unique_ptr<hal::DigitalOutput>& into) {
    take(what, into, hal_linux::GpioOutput::open(line_name(address)));
  }
  void input(const std::string& what, const config::LineAddress& address,
             std::unique_ptr<hal::DigitalInput>& into) {
    take(what, into, hal_linux::GpioInput::open(line_name(address)));
  }
  void pwm(const std::string& what, const config::PwmAddress& address,
           std::unique_ptr<hal::PwmOutput>& into) {
    std::unique_ptr<hal::PwmOutput> direct;
    take(what, direct,
         hal_linux::SysfsPwm::open(
             {address.device, address.number, address.period_ns, address.steps}));
    if (!direct || !address.access.buffered()) {
      into = std::move(direct);
      return;
    }
    auto buffered = std::make_unique<hal_linux::BufferedPwm>(std::move(direct));
    bus(address.access.bus).duties.push_back(buffered.get());
    into = std::move(buffered);
  }
  void converter(const std::string& what, const config::ConverterAddress& address,
                 std::unique_ptr<hal::AdcChannel>& into) {
    std::unique_ptr<hal::AdcChannel> direct;
    take(what, direct, hal_linux::IioAdc::open({address.device, address.input}));
    if (!direct || !address.access.buffered()) {
      into = std::move(direct);
      return;
    }
    auto buffered = std::make_unique<hal_linux::BufferedAdc>(std::move(direct));
    bus(address.access.bus).conversions.push_back(buffered.get());
    into = std::move(buffered);
  }
  std::vector<std::string> problems() && { return std::move(problems_); }

 private:
  Bus& bus(const std::string& name) {
    const auto same = [&](const Bus& bus) { return bus.name == name; };
    const auto found = std::find_if(board_->buses_.begin(), board_->buses_.end(), same);
    if (found != board_->buses_.end()) return *found;
    return board_->buses_.emplace_back(Bus{name, {}, {}});
  }

  LinuxBoard* board_;
  std::vector<std::string> problems_;
};

tl::expected<std::unique_ptr<LinuxBoard>, std::vector<std::string>> LinuxBoard::open(
    const config::BoardWiring& wiring) {
  std::unique_ptr<LinuxBoard> board(new LinuxBoard);
  Opening opening(*board);
  board->channels_.resize(wiring.channels.size());
  board->watchdog_address_ = wiring.watchdog;
  const auto name = [](std::size_t i, const char* what) {
    return "channel " + std::to_string(i + 1) + ", " + what;
  };
  // Off first: the lines that cut, then the duties.
  opening.output("heartbeat", wiring.heartbeat, board->heartbeat_);
  for (std::size_t i = 0; i < wiring.channels.size(); ++i)
    opening.output(name(i, "enable"), wiring.channels[i].enable, board->channels_[i].enable);
  for (std::size_t i = 0; i < wiring.channels.size(); ++i)
    opening.pwm(name(i, "pwm"), wiring.channels[i].pwm, board->channels_[i].pwm);
  opening.input("stop_circuit", wiring.stop_circuit, board->stop_circuit_);
  if (wiring.light) opening.output("light", *wiring.light, board->light_);
  opening.converter("supply", wiring.supply, board->supply_);
  for (std::size_t i = 0; i < wiring.channels.size(); ++i) {
    const config::ChannelWiring& channel = wiring.channels[i];
    opening.converter(name(i, "position"), channel.position, board->channels_[i].position);
    opening.converter(name(i, "current"), channel.current, board->channels_[i].current);
  }
  auto problems = std::move(opening).problems();
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return board;
}

tl::expected<void, std::string> LinuxBoard::start(double rate_Hz, int priority) {
  for (const Bus& bus : buses_) {
    std::vector<hal_linux::Served*> devices = bus.duties;
    devices.insert(devices.end(), bus.conversions.begin(), bus.conversions.end());
    auto thread = hal_linux::BusThread::start({"bus " + bus.name, priority},
                                              hal::duration_from(1.0 / rate_Hz), devices);
    if (!thread) return tl::unexpected(thread.error().text);
    threads_.push_back(std::move(*thread));
  }
  if (!watchdog_address_) return {};
  auto watchdog =
      hal_linux::DevWatchdog::open(watchdog_address_->device, watchdog_address_->timeout_s);
  if (!watchdog) return tl::unexpected("watchdog: " + watchdog.error().text);
  watchdog_ = std::move(*watchdog);
  if (!watchdog_->outlives_program()) {
    log(Level::warning, "the watchdog " + watchdog_address_->device +
                            " stops when this program ends: it guards only against a hang");
  }
  return {};
}

void LinuxBoard::release() {
  if (!watchdog_) return;
  if (const hal::Status status = watchdog_->release(); status != hal::Status::ok) {
    log(Level::warning, std::string("the watchdog cannot be stopped (") + hal::text(status) +
                            ") and will reset this board");
  }
}

board::Devices LinuxBoard::devices() {
  board::Devices devices{
      &clock_, supply_.get(), heartbeat_.get(), stop_circuit_.get(), light_.get(), watchdog_.get(),
      {}};
  for (const Channel& channel : channels_) {
    devices.channels.push_back(
        {channel.pwm.get(), channel.enable.get(), channel.position.get(), channel.current.get()});
  }
  return devices;
}

std::vector<hal_linux::SetupStep> LinuxBoard::steps() const {
  std::vector<hal_linux::SetupStep> all;
  for (const auto& thread : threads_)
    all.insert(all.end(), thread->steps().begin(), thread->steps().end());
  return all;
}

}  // namespace supercoil::daemon
