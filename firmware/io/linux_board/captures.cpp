#include "linux_board/captures.hpp"

#include <algorithm>
#include <utility>

namespace supercoil::linux_board {

namespace {

/// One input of a capture; it keeps the capture running.
class CapturedInput final : public hal::AdcChannel {
 public:
  CapturedInput(std::shared_ptr<hal_linux::IioScan> scan, std::size_t index)
      : scan_(std::move(scan)), input_(&scan_->input(index)) {}
  hal::Sample latest() override { return input_->latest(); }

 private:
  std::shared_ptr<hal_linux::IioScan> scan_;
  hal::AdcChannel* input_;
};

}  // namespace

Captures::Captures(const config::BoardWiring& wiring, hal_linux::Machine machine)
    : machine_(std::move(machine)) {
  add(wiring.supply);
  if (wiring.air) add(*wiring.air);
  for (const config::ChannelWiring& channel : wiring.channels) {
    if (!channel.position_of) add(channel.position);
    add(channel.current);
  }
}

void Captures::add(const config::ConverterAddress& input) {
  if (!input.capture) return;
  hal_linux::ScanLocation& place = demanded_[input.device];
  place.device = input.device;
  place.inputs.push_back(input.input);
  place.trigger = input.capture->trigger;
  place.length = input.capture->length;
  place.root = machine_.converters();
  place.dev = machine_.dev;
}

Captures::Scan& Captures::scan_of(const std::string& device) {
  const auto found = opened_.find(device);
  if (found != opened_.end()) return found->second;
  auto scan = hal_linux::IioScan::open(demanded_.at(device));
  return opened_
      .emplace(device, scan ? Scan(std::shared_ptr<hal_linux::IioScan>(std::move(*scan)))
                            : Scan(tl::unexpected(scan.error())))
      .first->second;
}

Result<std::unique_ptr<hal::AdcChannel>> Captures::open(const config::ConverterAddress& input) {
  const Scan& scan = scan_of(input.device);
  if (!scan) return tl::unexpected(scan.error());
  const std::vector<std::string>& inputs = demanded_.at(input.device).inputs;
  const auto place = std::find(inputs.begin(), inputs.end(), input.input);
  return std::make_unique<CapturedInput>(*scan, static_cast<std::size_t>(place - inputs.begin()));
}

}  // namespace supercoil::linux_board
