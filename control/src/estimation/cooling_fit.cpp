#include "supercoil/control/estimation/cooling_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace supercoil::control {

CoolingFit::CoolingFit(const Settings& settings, double step_s) : settings_(settings) {
  ticks_ = std::max(1, static_cast<int>(std::lround(target_step_s / step_s)));
  step_s_ = ticks_ * step_s;
  smoothing_ = -std::expm1(-corner_rad_per_s * step_s_);
  const double from_s = settings.min_time_constant_s / margin;
  const double ratio =
      settings.max_time_constant_s / settings.min_time_constant_s * margin * margin;
  for (std::size_t i = 0; i < candidates; ++i)
    fits_[i].tau_s = from_s * std::pow(ratio, static_cast<double>(i) / (candidates - 1));
  start();
}

void CoolingFit::start() {
  for (Fit& fit : fits_)
    fit = Fit{.tau_s = fit.tau_s};
  position_ = {};
  steps_ = 0;
  n_ = 0;
  position_sum_m_ = power_sum_W_ = mean_W_ = 0.0;
}

void CoolingFit::step(double position_m, double power_W) {
  position_sum_m_ += position_m;
  power_sum_W_ += power_W;
  if (++n_ < ticks_) return;
  add_sample(position_sum_m_ / n_, power_sum_W_ / n_);
  n_ = 0;
  position_sum_m_ = power_sum_W_ = 0.0;
}

std::optional<CoolingFit::Found> CoolingFit::found() const {
  if (used_s() < min_used_s) return std::nullopt;
  std::array<double, candidates> left{};
  for (std::size_t i = 0; i < candidates; ++i)
    left[i] = unexplained(fits_[i]);
  const auto best =
      static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
  if (best < min_distance || best + min_distance >= candidates || !(left[best] <= max_unexplained))
    return std::nullopt;
  for (std::size_t i = 0; i < candidates; ++i) {
    const bool near = i + min_distance > best && i < best + min_distance;
    if (!near && !(left[i] >= min_sharpness * left[best])) return std::nullopt;
  }
  // The lowest point of a parabola through the best and its neighbours.
  const double before = left[best - 1] - left[best];
  const double after = left[best + 1] - left[best];
  const double shift = before + after > 0.0 ? 0.5 * (before - after) / (before + after) : 0.0;
  return Found{fits_[best].tau_s * std::pow(fits_[1].tau_s / fits_[0].tau_s, shift), mean_W_};
}

void CoolingFit::add_sample(double position_m, double power_W) {
  const double x = position_m / scale_m;
  if (steps_ == 0) position_.once = position_.twice = x;
  position_.once += smoothing_ * (x - position_.once);
  position_.twice += smoothing_ * (position_.once - position_.twice);
  const bool used = step_s_ * static_cast<double>(steps_) >= settle_s;
  for (Fit& fit : fits_)
    add_sample(fit, x, power_W, used);
  ++steps_;
  if (!used) return;
  const double n = used_s() / step_s_;
  mean_W_ += (power_W - mean_W_) / std::max(1.0, n);
  position_.sum += position_.twice;
  position_.energy += position_.twice * position_.twice;
}
void CoolingFit::add_sample(Fit& fit, double x, double power_W, bool used) const {
  fit.loss_W += -std::expm1(-step_s_ / fit.tau_s) * (power_W - fit.loss_W);
  const double u = fit.loss_W / settings_.max_W;
  const double time = step_s_ * static_cast<double>(steps_) / 60.0;
  fit.fine.step(u);
  fit.coarse.step(u);
  const std::array<double, filtered> now{
      1.0, u, u * u, u * u * u, fit.fine.output(), fit.coarse.output(), time};
  for (std::size_t i = 0; i < filtered; ++i) {
    if (steps_ == 0) fit.once[i] = fit.twice[i] = now[i];
    fit.once[i] += smoothing_ * (now[i] - fit.once[i]);
    fit.twice[i] += smoothing_ * (fit.once[i] - fit.twice[i]);
  }
  if (!used) return;
  Vector<double, terms> psi;
  for (int i = 0; i < filtered; ++i)
    psi[i] = fit.twice[static_cast<std::size_t>(i)];
  psi[filtered] = position_.once - position_.twice;
  psi[filtered + 1] = x - 2.0 * position_.once + position_.twice;
  fit.information += psi * psi.transpose();
  fit.correlation += psi * position_.twice;
}
double CoolingFit::unexplained(const Fit& fit) const {
  Matrix<double, terms> information = fit.information;
  information.diagonal() *= 1.0 + ridge;
  const Vector<double, terms> c = information.ldlt().solve(fit.correlation);
  const double n = used_s() / step_s_;
  const double left = position_.energy - 2.0 * c.dot(fit.correlation) + c.dot(fit.information * c);
  return left / (position_.energy - position_.sum * position_.sum / n);
}

double CoolingFit::used_s() const {
  return std::max(0.0, step_s_ * static_cast<double>(steps_) - settle_s);
}

}  // namespace supercoil::control
