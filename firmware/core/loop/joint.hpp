// A joint: the axes of two channels whose muscles pull against each other.
#pragma once

#include <array>
#include <cstdint>

#include "loop/axis.hpp"
#include "loop/settings.hpp"

namespace supercoil {

/// The agonist's axis follows the joint's position, and what its controller asks for is the effort
/// of both muscles. States, faults and commands are the channels' own (Channel::join).
class Joint {
 public:
  /// Both axes outlive the joint.
  Joint(const JointSettings& settings, Axis& agonist, Axis& antagonist, double step_s);

  // In a tick:
  /// Before the channels are judged: each axis learns what the other muscle does.
  void observe();
  /// After both axes know what they want: the powers of both heaters.
  void limit();

 private:
  /// Slow against every controller, so that what the muscles differ in is not seen at the joint.
  static constexpr double co_contraction_lag_s = 10.0;

  /// What follows from the muscles' gains.
  struct Gains {
    double ratio;  ///< a watt of the antagonist turns the joint so much further
    double inverse_ratio;
    double max_antagonist_W;  ///< of co-contraction, in watts of its own
  };

  Gains calculated_gains() const;
  /// Of the muscles as they are known.
  const Gains& gains();
  /// Of co-contraction, that keeps both muscles taut; 0: any does, or it is not known.
  double taut_W(double gain_ratio) const;
  void follow_co_contraction(bool active, double gain_ratio);
  void limit_each(double max_antagonist_W);

  JointSettings settings_;
  Axis& agonist_;
  Axis& antagonist_;
  double first_W_;    ///< of co-contraction, in watts of the agonist as all here
  double max_W_;      ///< likewise
  double lag_ratio_;  ///< of a tick to co_contraction_lag_s
  double inverse_lever_ratio_;
  /// Of both muscles when gains_ were calculated, with divisions that a tick need not make.
  std::array<std::uint32_t, 2> knowledge_;
  Gains gains_;
  bool was_active_ = false;
  double nearly_W_ = 0.0;
  double co_contraction_W_ = 0.0;  ///< through two low-passes, so that its rate does not jump
};

}  // namespace supercoil
