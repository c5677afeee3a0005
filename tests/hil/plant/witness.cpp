#include "witness.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace supercoil::rig {

namespace {

constexpr hal::Duration every = std::chrono::milliseconds(10);

// Text without the heap and without formats: it is written within a step.
class Line {
 public:
  explicit Line(char kind) { text_[used_++] = kind; }
  template <typename Integer>
  Line& add(Integer number) {
    text_[used_++] = ' ';
    used_ = static_cast<std::size_t>(
        std::to_chars(text_.data() + used_, text_.data() + text_.size(), number).ptr -
        text_.data());
    return *this;
  }
  Line& add_thousandths(double number) { return add(std::lround(number * 1e3)); }
  const char* end_line() {
    text_[used_++] = '\n';
    return text_.data();
  }
  std::size_t size() const { return used_; }

 private:
  std::array<char, 512> text_{};
  std::size_t used_ = 0;
};

auto microseconds(hal::Duration time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time).count();
}

}  // namespace

Witness::Witness(const std::string& path)
    : file_(path.empty() ? dup(STDOUT_FILENO) : open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), path);
}

Witness::~Witness() {
  close(file_);
}

void Witness::write_line(const char* text, std::size_t length) const {
  if (write(file_, text, length) != static_cast<ssize_t>(length))
    throw std::system_error(errno, std::generic_category(), "witness");
}

void Witness::note(const std::string& line) {
  const std::string whole = line + "\n";
  write_line(whole.data(), whole.size());
}

void Witness::look(const Plant& plant, hal::Time now) {
  const host_sim::SimulatedBoard& board = plant.board();
  if (board.heartbeat.edges() != edges_) {
    edges_ = board.heartbeat.edges();
    edge_ = now;
  }
  std::uint64_t state = plant.stop_closed() ? 1U : 0U;
  const auto also = [&state](bool bit) { state = state << 1 | (bit ? 1U : 0U); };
  also(plant.light());
  also(board.supply_closed());
  for (std::size_t i = 0; i < plant.channels(); ++i) {
    also(plant.enabled(i));
    also(plant.duty_4096(i) > 0);
  }
  if (state == state_ && now < next_) return;
  state_ = state;
  next_ = now + every;

  Line line('W');
  line.add(microseconds(now)).add(edges_).add(microseconds(edge_));
  line.add(plant.stop_closed() ? 1 : 0).add(plant.light() ? 1 : 0);
  line.add(board.supply_closed() ? 1 : 0);
  for (std::size_t i = 0; i < plant.channels(); ++i) {
    const host_sim::MuscleChannel& channel = board.channel(i);
    line.add(plant.enabled(i) ? 1 : 0).add(plant.duty_4096(i));
    line.add_thousandths(channel.true_power_W());
    line.add_thousandths(channel.position_m() * 1e3);
    line.add_thousandths(channel.temperature_rise_K());
    line.add_thousandths(channel.current_A());
  }
  const char* text = line.end_line();
  write_line(text, line.size());
}

void Witness::step_took(hal::Time now, hal::Duration took, hal::Duration late, int missed) {
  sum_ += took;
  max_ = std::max(max_, took);
  latest_ = std::max(latest_, late);
  missed_ += missed;
  ++steps_;
  if (now - counted_since_ < std::chrono::seconds(1)) return;
  Line line('S');
  line.add(microseconds(now)).add(steps_).add(missed_).add(microseconds(sum_ / steps_));
  line.add(microseconds(max_)).add(microseconds(latest_));
  const char* text = line.end_line();
  write_line(text, line.size());
  counted_since_ = now;
  sum_ = max_ = latest_ = {};
  steps_ = missed_ = 0;
}

}  // namespace supercoil::rig
