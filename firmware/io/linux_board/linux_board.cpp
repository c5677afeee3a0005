#include "linux_board/linux_board.hpp"

#include <algorithm>

#include "supercoil/hal_linux/buffered_adc.hpp"
#include "supercoil/hal_linux/buffered_pwm.hpp"

#include "linux_board/parts.hpp"

namespace supercoil::linux_board {

/// Takes over opened devices; wraps those behind a bus, so that the bus's thread serves them.
class LinuxBoard::Taking {
 public:
  explicit Taking(LinuxBoard& board) : board_(&board) {}

  std::unique_ptr<hal::PwmOutput> pwm(PwmPart& part, const config::Access& access) const {
    if (!access.buffered()) return std::move(*part.device);
    auto buffered = std::make_unique<hal_linux::BufferedPwm>(std::move(*part.device));
    bus(access.bus).duties.push_back(buffered.get());
    return buffered;
  }
  std::unique_ptr<hal::AdcChannel> converter(ConverterPart& part,
                                             const config::Access& access) const {
    if (!access.buffered()) return std::move(*part.device);
    auto buffered = std::make_unique<hal_linux::BufferedAdc>(std::move(*part.device));
    bus(access.bus).conversions.push_back(buffered.get());
    return buffered;
  }

 private:
  Bus& bus(const std::string& name) const {
    const auto same = [&](const Bus& bus) { return bus.name == name; };
    const auto found = std::find_if(board_->buses_.begin(), board_->buses_.end(), same);
    if (found != board_->buses_.end()) return *found;
    return board_->buses_.emplace_back(Bus{name, {}, {}});
  }

  LinuxBoard* board_;
};

tl::expected<std::unique_ptr<LinuxBoard>, std::vector<std::string>> LinuxBoard::open(
    const config::BoardWiring& wiring) {
  Parts parts = open_parts(wiring);
  if (auto missing = parts.missing(); !missing.empty()) return tl::unexpected(std::move(missing));
  std::unique_ptr<LinuxBoard> board(new LinuxBoard);
  const Taking take(*board);
  board->watchdog_address_ = wiring.watchdog;
  board->heartbeat_ = std::move(*parts.heartbeat.device);
  board->stop_circuit_ = std::move(*parts.stop_circuit.device);
  if (parts.light) board->light_ = std::move(*parts.light->device);
  board->supply_ = take.converter(parts.supply, wiring.supply.access);
  if (parts.air) board->air_ = take.converter(*parts.air, wiring.air->access);
  for (std::size_t i = 0; i < wiring.channels.size(); ++i) {
    const config::ChannelWiring& where = wiring.channels[i];
    ChannelParts& channel = parts.channels[i];
    auto enable = std::move(*channel.enable.device);
    auto pwm = take.pwm(channel.pwm, where.pwm.access);
    std::shared_ptr<hal::AdcChannel> position;
    if (!where.position_of) position = take.converter(*channel.position, where.position.access);
    board->channels_.push_back({std::move(enable), std::move(pwm), std::move(position),
                                take.converter(channel.current, where.current.access)});
  }
  // Only now, as the channel that owns the position may come later.
  for (std::size_t i = 0; i < wiring.channels.size(); ++i) {
    if (const auto owner = wiring.channels[i].position_of)
      board->channels_[i].position = board->channels_[*owner].position;
  }
  return board;
}

Result<std::string> LinuxBoard::start(double rate_Hz, int priority) {
  for (const Bus& bus : buses_) {
    std::vector<hal_linux::BusDevice*> devices = bus.duties;
    devices.insert(devices.end(), bus.conversions.begin(), bus.conversions.end());
    auto thread = hal_linux::BusThread::start({"bus " + bus.name, priority},
                                              hal::duration_from(1.0 / rate_Hz), devices);
    if (!thread) return tl::unexpected(thread.error());
    threads_.push_back(std::move(*thread));
  }
  if (!watchdog_address_) return {};
  auto watchdog =
      hal_linux::DevWatchdog::open(watchdog_address_->device, watchdog_address_->timeout_s);
  if (!watchdog) return failure("watchdog: " + watchdog.error().text());
  watchdog_ = std::move(*watchdog);
  if (watchdog_->outlives_program()) return {};
  return "the watchdog " + watchdog_address_->device +
         " stops when this program ends: it guards only against a hang";
}

std::string LinuxBoard::release() {
  if (!watchdog_) return {};
  const hal::Status status = watchdog_->release();
  if (status == hal::Status::ok) return {};
  return std::string("the watchdog cannot be stopped (") + hal::text(status) +
         ") and will reset this board";
}

board::Devices LinuxBoard::devices() {
  board::Devices devices{
      &clock_, supply_.get(), heartbeat_.get(), stop_circuit_.get(), light_.get(), watchdog_.get(),
      {},      air_.get()};
  for (const Channel& channel : channels_) {
    devices.channels.push_back(
        {channel.pwm.get(), channel.enable.get(), channel.position.get(), channel.current.get()});
  }
  return devices;
}

std::vector<BusReport> LinuxBoard::buses() const {
  std::vector<BusReport> reports;
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    const hal_linux::BusHealth& health = threads_[i]->health();
    reports.push_back(
        {buses_[i].name, health.skipped.load(std::memory_order_relaxed),
         1e-9 * static_cast<double>(health.max_round_ns.load(std::memory_order_relaxed))});
  }
  return reports;
}

std::vector<hal_linux::SetupStep> LinuxBoard::steps() const {
  std::vector<hal_linux::SetupStep> all;
  for (const auto& thread : threads_)
    all.insert(all.end(), thread->steps().begin(), thread->steps().end());
  return all;
}

}  // namespace supercoil::linux_board
