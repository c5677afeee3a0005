// The steps of setup, in order.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "loop/settings.hpp"

namespace supercoil::operating {

struct SetupStep {
  std::string_view name;
  std::string_view does;  ///< printed before it begins
  bool optional = false;  ///< may be skipped
  bool needs_person =
      false;  ///< a person is asked first whether to skip it; a script without its table skips it
  enum class InJoint { of_each, of_agonist, never } in_joint = InJoint::of_each;
  bool of_each_in_bundle = false;  ///< else once, by the leading channel, for all
  bool of_machine =
      false;  ///< if it is done, that implies nothing about the muscle, nor about steps before it
};

/// Why a step is not done with this channel, from 0; empty: it is.
std::string left_out(const SetupStep& step, const BoardSettings& board, std::size_t channel);

inline constexpr std::array<SetupStep, 9> setup_steps{{
    {"describe",
     "writes what is known of the muscle, with its bounds and a controller, into the board's "
     "file; heats nothing",
     false, false, SetupStep::InJoint::of_each, true},
    {"doctor",
     "looks at the board's own machine: kernel, rights to run in real time, processors, buses, "
     "watchdog, and devices while no supercoild has them; reports what fails; heats nothing",
     true, false, SetupStep::InJoint::of_each, true, true},
    {"senses",
     "compares the senses of supply and current with a meter: heats it with a small steady power, "
     "and asks four questions; until then less power is allowed",
     true, true, SetupStep::InJoint::of_each, true},
    {"calibrate",
     "takes the zero and the resistance of the cold muscle; heats it for 50 ms; takes seconds, or "
     "up to two minutes if it must cool"},
    {"scale", "takes the scale of the position from a second known place; heats nothing", true,
     true, SetupStep::InJoint::never},
    {"limits",
     "finds how far it may move: pulls with a power that rises slowly until you say that its end "
     "has come as far as it may, or touches something; makes the file's limit smaller, never "
     "larger",
     true, true},
    {"identify",
     "heats and lets cool three to nine times, up to 0.85 of its reach, and again in shorter "
     "strokes "
     "if it is far from linear; a minute for a quick muscle, eight for one with a time constant of "
     "a minute, and up to three times that if it is far from linear"},
    {"gains",
     "compares the controller in use with the one that suits the muscle that was found, and takes "
     "that one over if it differs and you want it; heats nothing",
     true, false, SetupStep::InJoint::of_agonist},
    {"move",
     "follows a slow sine between 0.24 and 0.56 of the travel that it can hold, less for a slow "
     "muscle, three periods of 36 s at most; compares the error with the promised one",
     false, false, SetupStep::InJoint::of_agonist},
}};

}  // namespace supercoil::operating
