#include "estimators/outcome.hpp"

#include <cmath>
#include <cstdint>

namespace supercoil::host_sim::estimators {

using control::Theta;

namespace {

constexpr std::int64_t sample_every_ticks = 10;
constexpr std::int64_t poll_every_ticks = 4096;
/// An exit so shortly before the end counts as never within the band.
constexpr double unsettled_s = 1.0;

/// When each parameter was last outside a band.
class LastExit {
 public:
  LastExit(double band, double from_s, double to_s) : band_(band), from_s_(from_s), to_s_(to_s) {}

  void observe(double time_s, const Theta& error) {
    // At to_s itself the muscle has already changed.
    if (time_s <= from_s_ || time_s > to_s_ - tick_s / 2.0) return;
    for (int i = 0; i < 4; ++i) {
      // NaN counts as outside.
      if (!(std::abs(error[i]) <= band_)) last_s_[i] = time_s - from_s_;
    }
  }
  Theta times_s() const {
    const double latest_s = to_s_ - from_s_ - unsettled_s;
    return last_s_.unaryExpr([&](double s) { return s > latest_s ? INFINITY : s; });
  }

 private:
  double band_;
  double from_s_;
  double to_s_;
  Theta last_s_ = Theta::Zero();
};

/// Squares of the errors at plotted_s.
class Samples {
 public:
  explicit Samples(double from_s) : from_s_(from_s) {}

  void observe(double time_s, const Theta& error) {
    const auto& times_s = plotted_s();
    while (squares_.size() < times_s.size() &&
           time_s - from_s_ >= times_s[squares_.size()] - tick_s / 2.0)
      squares_.emplace_back(error.cwiseAbs2());
  }
  const std::vector<Theta>& squares() const { return squares_; }

 private:
  double from_s_;
  std::vector<Theta> squares_;
};

}  // namespace

const std::vector<double>& plotted_s() {
  static const std::vector<double> times_s = [] {
    constexpr int points = 61;
    constexpr double first_s = 0.1;
    constexpr double last_s = 99.0;
    std::vector<double> times;
    times.reserve(points);
    for (int i = 0; i < points; ++i)
      times.push_back(first_s * std::pow(last_s / first_s, static_cast<double>(i) / (points - 1)));
    return times;
  }();
  return times_s;
}

std::optional<Outcome> run(const ContenderKind& kind, const Trial& trial, std::uint64_t seed,
                           const std::atomic<bool>& stop) {
  Bench bench(trial, seed);
  const auto contender = kind.make(trial.initial(), tick_s);
  LastExit wide(wide_band, 0.0, trial.change_at_s);
  LastExit narrow(narrow_band, 0.0, trial.change_at_s);
  LastExit back(wide_band, trial.change_at_s, trial.duration_s);
  Samples from_rest(0.0);
  Samples after_change(trial.change_at_s);
  Theta squares = Theta::Zero();
  Theta variances = Theta::Zero();
  double samples = 0.0;
  while (!bench.done()) {
    if (bench.ticks() % poll_every_ticks == 0 && stop) return std::nullopt;
    const Bench::Tick tick = bench.next();
    contender->step(tick.position_m, tick.power_W);
    if (bench.ticks() % sample_every_ticks != 0) continue;
    const Theta error = contender->theta().cwiseQuotient(bench.truth()) - Theta::Ones();
    wide.observe(tick.time_s, error);
    narrow.observe(tick.time_s, error);
    back.observe(tick.time_s, error);
    if (tick.time_s < trial.change_at_s) from_rest.observe(tick.time_s, error);
    if (tick.time_s > trial.change_at_s) after_change.observe(tick.time_s, error);
    if (tick.time_s > trial.change_at_s - steady_s && tick.time_s < trial.change_at_s) {
      squares += error.cwiseAbs2();
      variances += contender->standard_deviations().cwiseAbs2();
      ++samples;
    }
  }
  return Outcome{wide.times_s(),
                 narrow.times_s(),
                 back.times_s(),
                 (squares / samples).cwiseSqrt(),
                 (variances / samples).cwiseSqrt(),
                 from_rest.squares(),
                 after_change.squares()};
}

}  // namespace supercoil::host_sim::estimators
