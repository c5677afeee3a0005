// A joint: the axes of two channels whose muscles pull against each other.
#pragma once

#include <array>
#include <cstdint>

#include "loop/axis.hpp"
#include "loop/settings.hpp"

namespace supercoil {

/// The agonist's axis follows the joint's position, and its controller's demand is the effort of
/// both muscles. States, faults and commands remain with the channels (Channel::lead_joint).
class Joint {
 public:
  /// Both axes outlive the joint.
  Joint(const JointSettings& settings, Axis& agonist, Axis& antagonist, double step_s);

  // In a tick:
  /// Before the channels are supervised: tells each axis what the other muscle does.
  void observe();
  /// After both axes have their demand: sets the power of both heaters.
  void limit();

 private:
  /// Slow compared with every controller, so that the joint shows no difference of the muscles.
  static constexpr double co_contraction_lag_s = 10.0;

  /// Values that follow from the muscles' gains.
  struct Gains {
    double ratio;  ///< joint motion per watt of the antagonist over that of the agonist
    double inverse_ratio;
    double max_antagonist_W;  ///< of co-contraction, in the antagonist's watts
  };

  Gains calculated_gains() const;
  /// Of the muscles as now known.
  const Gains& gains();
  /// The co-contraction that keeps both muscles taut; 0: none is needed, or it is not known.
  double taut_W(double gain_ratio) const;
  void follow_co_contraction(bool active, double gain_ratio);
  void limit_each(double max_antagonist_W);

  JointSettings settings_;
  Axis& agonist_;
  Axis& antagonist_;
  double initial_W_;  ///< initial co-contraction, in the agonist's watts as all members here
  double max_W_;      ///< of co-contraction
  double lag_ratio_;  ///< a tick over co_contraction_lag_s
  double inverse_lever_ratio_;
  /// knowledge() of both axes when gains_ were calculated, which saves a tick their divisions.
  std::array<std::uint32_t, 2> knowledge_;
  Gains gains_;
  bool was_active_ = false;
  double filtered_W_ = 0.0;
  double co_contraction_W_ = 0.0;  ///< through two low-passes, so that its rate does not jump
};

}  // namespace supercoil
