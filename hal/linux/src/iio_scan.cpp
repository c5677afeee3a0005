#include "supercoil/hal_linux/iio_scan.hpp"

#include <algorithm>
#include <utility>

namespace supercoil::hal_linux {

class IioScan::Input final : public hal::AdcChannel {
 public:
  Input(IioScan& scan, std::size_t index) : scan_(&scan), index_(index) {}

  hal::Sample latest() override {
    scan_->take_newest();
    return scan_->sample(index_);
  }

 private:
  IioScan* scan_;
  std::size_t index_;
};

Result<std::unique_ptr<IioScan>> IioScan::open(const ScanLocation& place) {
  auto ready = set_up_scan(place);
  if (!ready) return tl::unexpected(ready.error());
  auto scan = std::make_unique<IioScan>(std::move(*ready), place.length);
  if (auto enabled = scan->ready_.enable.set("1"); !enabled) {
    return tl::unexpected(enabled.error());
  }
  return scan;
}

IioScan::IioScan(ReadyScan ready, int length)
    : ready_(std::move(ready)),
      buffer_(ready_.bytes * static_cast<std::size_t>(length)),
      newest_(ready_.bytes) {
  for (std::size_t i = 0; i < ready_.inputs.size(); ++i) {
    inputs_.push_back(std::make_unique<Input>(*this, i));
  }
}

IioScan::~IioScan() {
  static_cast<void>(ready_.enable.write(0));
}

hal::AdcChannel& IioScan::input(std::size_t index) {
  return *inputs_[index];
}

void IioScan::take_newest() noexcept {
  const Transfer got =
      read_next(ready_.device, reinterpret_cast<char*>(buffer_.data()), buffer_.size());
  // Nothing new: the newest scan stays, with its own time.
  if (got.status == hal::Status::not_ready) return;
  status_ = got.status;
  if (status_ != hal::Status::ok) return;
  if (got.bytes % ready_.bytes != 0) {
    status_ = hal::Status::io_error;
    return;
  }
  std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(got.bytes - ready_.bytes), ready_.bytes,
              newest_.begin());
  taken_ = hal::Time(value_of(ready_.timestamp.type, newest_.data() + ready_.timestamp.offset));
}

hal::Sample IioScan::sample(std::size_t index) const noexcept {
  const ScanElement& element = ready_.inputs[index];
  const auto value = value_of(element.type, newest_.data() + element.offset);
  return {static_cast<std::int32_t>(value), taken_, status_};
}

}  // namespace supercoil::hal_linux
