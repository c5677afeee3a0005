// A bundle: the axes of channels whose muscles pull together.
#pragma once

#include <vector>

#include "loop/axis.hpp"

namespace supercoil {

/// The leader's axis is the bundle's: what its controller asks for every heater gives, and no more
/// than the weakest of them can. States, faults and commands are the channels' own
/// (Channel::lead_bundle).
class Bundle {
 public:
  /// All outlive the bundle.
  Bundle(Axis& leader, std::vector<Axis*> followers);

  // In a tick:
  /// Before the channels are judged: what one of them knows or may have the others learn.
  void observe();
  /// After the leader's axis knows what it wants: the powers of all heaters.
  void limit();

 private:
  Axis& leader_;
  std::vector<Axis*> followers_;
};

}  // namespace supercoil
