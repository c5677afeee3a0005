// Stable filters whose states are the derivatives that adaptive laws need.
#pragma once

#include <type_traits>

#include "supercoil/control/linear/discretize.hpp"
#include "supercoil/control/linear/polynomial.hpp"
#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// How the input behaves between samples. Powers and references are held; positions are not.
enum class Hold { zero_order, first_order };

/// The controllable companion form of 1/Λ(s), Λ monic: state [X, sX, …, s^(Order−1) X]/Λ.
template <int Order>
struct Companion {
  Matrix<double, Order> a = Matrix<double, Order>::Zero();
  Matrix<double, Order, 1> b = Matrix<double, Order, 1>::Zero();

  explicit Companion(const Polynomial<Order>& lambda) {
    for (int i = 0; i + 1 < Order; ++i)
      a(i, i + 1) = 1.0;
    for (int i = 0; i < Order; ++i)
      a(Order - 1, i) = -lambda[static_cast<std::size_t>(i)];
    b(Order - 1) = 1.0;
  }
};

/// State-variable filter 1/Λ(s), exactly discretised for its kind of input, starting at rest.
template <class Scalar, int Order, Hold hold>
class StateVariableFilter {
 public:
  using State = Vector<Accumulator<Scalar>, Order>;

  /// lambda: monic and Hurwitz, ascending. step_s: the sampling period in seconds, > 0.
  StateVariableFilter(const Polynomial<Order>& lambda, double step_s) {
    const Companion<Order> system(lambda);
    if constexpr (hold == Hold::zero_order) {
      const auto discrete = zero_order_hold<Order, 1>(system.a, system.b, step_s);
      transition_ = discrete.transition.template cast<Accumulator<Scalar>>();
      start_ = discrete.held.template cast<Accumulator<Scalar>>();
    } else {
      const auto discrete = first_order_hold<Order, 1>(system.a, system.b, step_s);
      transition_ = discrete.transition.template cast<Accumulator<Scalar>>();
      start_ = discrete.start.template cast<Accumulator<Scalar>>();
      end_ = discrete.end.template cast<Accumulator<Scalar>>();
    }
    for (int i = 0; i < Order; ++i) {
      lambda_[i] = Accumulator<Scalar>(lambda[static_cast<std::size_t>(i)]);
    }
  }

  /// Advances to this tick. With zero-order hold the input is the value held *since the last tick*;
  /// with first-order hold it is the sample of *this* tick.
  void step(Scalar input) {
    const Accumulator<Scalar> now(input);
    // Lazy: computed in place. g++ 12 would call Eigen's usual product, and wait for its result.
    State next = transition_.lazyProduct(state_);
    if constexpr (hold == Hold::zero_order) {
      next += start_ * now;
    } else {
      next += start_ * last_ + end_ * now;
    }
    last_ = now;
    state_ = next;
  }

  /// [X, sX, …, s^(Order−1) X]/Λ at this tick.
  const State& state() const { return state_; }

  /// The state after an input has long moved at a constant rate, in its unit per second.
  void settle(Scalar input, Scalar rate = Scalar{}) {
    last_ = Accumulator<Scalar>(input);
    const Accumulator<Scalar> slope = Accumulator<Scalar>(rate) / lambda_[0];
    state_ = State::Zero();
    state_[0] = last_ / lambda_[0] - slope * lambda_[1] / lambda_[0];
    state_[1] = slope;
  }
  /// Takes over a state and the input that belongs to it.
  void set(const State& state, Scalar input) {
    state_ = state;
    last_ = Accumulator<Scalar>(input);
  }

  /// s^Order X/Λ at this tick, for the given input of this tick.
  Accumulator<Scalar> highest_derivative(Scalar input) const {
    return Accumulator<Scalar>(input) - lambda_.dot(state_);
  }

 private:
  Matrix<Accumulator<Scalar>, Order> transition_;
  State start_;
  State end_ = State::Zero();
  State lambda_;
  State state_ = State::Zero();
  Accumulator<Scalar> last_{};
};

/// N first-order filters 1/(s + pole) side by side.
template <class Scalar, int N>
class OnePoleBank {
 public:
  using State = Vector<Accumulator<Scalar>, N>;

  /// pole_rad_per_s > 0. held[i]: input i keeps its value from tick to tick; the other inputs are
  /// linear in between.
  OnePoleBank(double pole_rad_per_s, double step_s, const std::array<bool, N>& held) {
    const Matrix<double, 1> a{-pole_rad_per_s};
    const Matrix<double, 1> b{1.0};
    const auto zero = zero_order_hold<1, 1>(a, b, step_s);
    const auto first = first_order_hold<1, 1>(a, b, step_s);
    pole_ = Accumulator<Scalar>(pole_rad_per_s);
    transition_ = Accumulator<Scalar>(zero.transition(0));
    for (int i = 0; i < N; ++i) {
      const bool is_held = held[static_cast<std::size_t>(i)];
      start_[i] = Accumulator<Scalar>(is_held ? zero.held(0) : first.start(0));
      end_[i] = Accumulator<Scalar>(is_held ? 0.0 : first.end(0));
    }
  }

  /// The inputs of this tick.
  void step(const State& input) {
    state_ = (state_ * transition_ + start_.cwiseProduct(last_) + end_.cwiseProduct(input)).eval();
    last_ = input;
  }
  const State& state() const { return state_; }

  /// The state after the inputs have long moved at constant rates, in their units per second.
  void settle(const State& input, const State& rate) {
    const Accumulator<Scalar> time_s = Accumulator<Scalar>(1) / pole_;
    last_ = input;
    state_ = (input - rate * time_s) * time_s;
  }

 private:
  Accumulator<Scalar> pole_;
  Accumulator<Scalar> transition_;
  State start_;
  State end_;
  State last_ = State::Zero();
  State state_ = State::Zero();
};

}  // namespace supercoil::control
