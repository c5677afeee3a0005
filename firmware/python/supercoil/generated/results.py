# Generated from docs/running.md and firmware/core/modes/result.hpp by toolchain/generate-can. Do not edit.

"""The results of identify and calibrate."""

from supercoil.generated.names import Result

MEANINGS = {
    Result.none: "not run since the start",
    Result.running: "it has not ended yet",
    Result.found: "used from now on, and stored",
    Result.interrupted: "ended by a command or a fault",
    Result.not_cold: "the muscle did not cool within two minutes",
    Result.moved: "the position changed by more than 0.1 mm while its zero was taken",
    Result.poor_fit: "the muscle did not move as the fit predicted, even in shorter strokes: play, a changing load or a slipping sensor",
    Result.uncertain: "θ3 or θ4, which controllers need, is not known well enough, or θ2 is hardly known: the sensor is too noisy for this motion",
    Result.implausible: "the result is out of range or, for identify, far from the configured muscle",
    Result.not_stored: "used from now on, but not stored: earlier results still wait for the disk",
    Result.too_little_motion: "the muscle moved by less than 1 % of its travel at the maximum power",
    Result.moved_backwards: "the muscle moved the wrong way when it was heated: the sensor's sign is wrong or, in a joint, the two heaters are swapped",
}

# Bits of identify's notes, from the least significant.
NOTES = ("theta1_kept", "theta2_uncertain", "theta3_uncertain", "theta4_uncertain", "poor_fit", "implausible", "too_little_motion", "friction")
