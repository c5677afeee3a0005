// A bundle: the axes of channels whose muscles pull together.
#pragma once

#include <vector>

#include "loop/axis.hpp"

namespace supercoil {

/// The leader's axis is the bundle's: every heater gives what its controller asks for, and no more
/// than the weakest can. States, faults and commands remain with the channels
/// (Channel::lead_bundle).
class Bundle {
 public:
  /// All axes outlive the bundle.
  Bundle(Axis& leader, std::vector<Axis*> followers);

  // In a tick:
  /// Before the channels are supervised: shares what the axes know and may do.
  void observe();
  /// After the leader's axis has its demand: sets the power of all heaters.
  void limit();

 private:
  Axis& leader_;
  std::vector<Axis*> followers_;
};

}  // namespace supercoil
