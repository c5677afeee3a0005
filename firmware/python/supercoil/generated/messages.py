# Generated from firmware/io/can/supercoil.dbc by toolchain/generate-can. Do not edit.

"""Every message as a type, and its layout in a frame. A value that is not available is NaN."""

from typing import NamedTuple

from supercoil.generated import names
from supercoil.layout import Layout, Raw, Signal


class Sync(NamedTuple):
    """The master's clock, for all boards on the bus; the identifier is always that of node 1. Each board notes when the frame arrived, to the microsecond if its kernel provides that, and follows this clock while it plays a trajectory. No board answers. Once a second is often enough."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    sync: int
    master_time_s: float


class Emergency(NamedTuple):
    """Sent immediately when the channel's fault changes: when a fault latches and, with fault none, when it is reset."""

    time_s: float  # when it was on the bus, by the receiver's clock
    fault: names.Fault
    state: names.State
    board_time_s: float


class FirstCause(NamedTuple):
    """Sent right after an Emergency that reports a fault: the margin of the detector that tripped, at that time."""

    time_s: float  # when it was on the bus, by the receiver's clock
    measured: float
    limit: float


class Knot(NamedTuple):
    """The next knot of a trajectory: a position that the muscle is to reach, and its velocity there. Position, velocity and acceleration are continuous between knots. Accepted while the muscle follows a position; any command other than a knot, Play and renew discards it. Renews the command to heat."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    after_s: float
    position_m: float
    velocity_m_per_s: float


class Play(NamedTuple):
    """Starts the trajectory; its time is 0 at its first knot. Renews the lease, but not the command to heat."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    when: names.When
    session: int
    sync: int
    after_s: float


class Trajectory(NamedTuple):
    """The answer to Knot and to Play; also sent whenever the state of the playback changes."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    answers: names.Answers
    session_low: int
    refusal: names.Refusal
    playback: names.Playback
    room: int
    buffered_s: float


class TuningRead(NamedTuple):
    """Asks for one value of a controller or estimator of this node. Needs no lease: reading changes nothing."""

    time_s: float  # when it was on the bus, by the receiver's clock
    place: int
    set: names.Set
    tunable: names.Tunable


class Command(NamedTuple):
    """One command to this node's channel. AUTOSAR E2E Profile 2; each of its 16 data ids is the low byte of the frame's identifier. Damage, loss and the repetition of a single frame are detected. Anyone who replays 16 recorded frames of a session in order is obeyed while that lease lasts, but no longer: the session ends with the lease or when the board starts, and a recorded lease frame does not restore it. A command to heat expires unless it is renewed."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    opcode: names.Opcode
    session: int
    value: float


class Acknowledge(NamedTuple):
    """The answer to a command, even if it is refused. A damaged command is not answered, because its sender is unknown. Protected in the same way as Command."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    opcode: names.Opcode
    session: int
    refusal: names.Refusal
    granted: int


class Measurement(NamedTuple):
    """The measured position and resistance of the muscle."""

    time_s: float  # when it was on the bus, by the receiver's clock
    position_m: float
    resistance_Ohm: float
    resistance_age_s: float


class Tracking(NamedTuple):
    """How well the muscle follows its reference. Available in mode position only."""

    time_s: float  # when it was on the bus, by the receiver's clock
    reference_m: float
    model_m: float
    error_m: float


class Power(NamedTuple):
    """The power that the controller demands, and the power that the muscle gets."""

    time_s: float  # when it was on the bus, by the receiver's clock
    demanded_W: float
    applied_W: float
    limited_by: names.LimitedBy
    limited: bool


class Heater(NamedTuple):
    """Supply voltage, current and duty of the heater."""

    time_s: float  # when it was on the bus, by the receiver's clock
    supply_V: float
    current_A: float
    duty: float


class Temperature(NamedTuple):
    """Bounds of the muscle's temperature, which is estimated and never measured."""

    time_s: float  # when it was on the bus, by the receiver's clock
    coldest_C: float
    hottest_C: float


class Estimate(NamedTuple):
    """What the board has learned about the muscle: one parameter in each frame, and whether the estimates are trusted. A round has the first 8 parameters and takes 0.8 s at the usual rate; while the estimator provides standard deviations (least_squares), a round has all 14 and takes 1.4 s."""

    time_s: float  # when it was on the bus, by the receiver's clock
    parameter: names.Parameter
    trusted: bool
    identify_notes: int
    error_bound: float
    theta1: float
    theta2: float
    theta3: float
    theta4: float
    thermal_mass_J_per_K: float
    heat_transfer_W_per_K: float
    stiffness_N_per_m: float
    damping_Ns_per_m: float
    bias_W: float
    theta1_deviation: float
    theta2_deviation: float
    theta3_deviation: float
    theta4_deviation: float
    bias_deviation_W: float


class Margin(NamedTuple):
    """How close a detector is to tripping; one detector in each frame, in turn."""

    time_s: float  # when it was on the bus, by the receiver's clock
    fault: names.Fault
    used: float
    measured: float


class Limit(NamedTuple):
    """The limit of a detector; one detector in each frame, in turn."""

    time_s: float  # when it was on the bus, by the receiver's clock
    fault: names.Fault
    limit: float


class Timing(NamedTuple):
    """Timing of the whole board, sent by its first node only."""

    time_s: float  # when it was on the bus, by the receiver's clock
    late_s: float
    execution_s: float
    overruns: int
    dropped_frames: int


class Gain(NamedTuple):
    """Gains of the active controller, in turn. An adaptive controller changes them."""

    time_s: float  # when it was on the bus, by the receiver's clock
    gain: names.Gain
    value: float


class RefusedValue(NamedTuple):
    """Sent right after an Acknowledge, a Setting or a Tuning that refuses a value as out_of_range: the refused value, and the nearest one that would have been obeyed. Boards of protocol version 3 and older, and the first boards of version 4, do not send it."""

    time_s: float  # when it was on the bus, by the receiver's clock
    value: float
    nearest: float


class Muscle(NamedTuple):
    """The answer to MuscleRead. Boards older than supercoil 0.2.0 do not answer."""

    time_s: float  # when it was on the bus, by the receiver's clock
    quantity: names.Quantity
    value: float


class Setting(NamedTuple):
    """The answer to SettingWrite and SettingRead: the value that now applies, even if the write was refused. Protected in the same way as Command."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    setting: names.Setting
    refusal: names.Refusal
    session_low: int
    value: float


class SettingWrite(NamedTuple):
    """Changes one setting of this node until the board restarts. Needs the lease, and is protected in the same way as Command. The counter continues from the last protected message."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    setting: names.Setting
    session: int
    value: float


class SettingRead(NamedTuple):
    """Asks for one setting of this node. Needs no lease: reading changes nothing."""

    time_s: float  # when it was on the bus, by the receiver's clock
    setting: names.Setting


class MuscleRead(NamedTuple):
    """Asks for one quantity of this node's muscle. Needs no lease: reading changes nothing."""

    time_s: float  # when it was on the bus, by the receiver's clock
    quantity: names.Quantity


class Tuning(NamedTuple):
    """The answer to TuningRead and TuningWrite. Protected in the same way as Command. Boards older than supercoil 0.2.0 do not answer."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    place: int
    tunable: names.Tunable
    refusal: names.Refusal
    set: names.Set
    value: float


class Status(NamedTuple):
    """Heartbeat of the channel. It stops when the control loop stops."""

    time_s: float  # when it was on the bus, by the receiver's clock
    state: names.State
    mode: names.Mode
    fault: names.Fault
    limited_by: names.LimitedBy
    probing: bool
    trusted: bool
    limited: bool
    leased: bool
    controller: int
    progress: float
    counter: int
    protocol_version: int
    result: names.Result
    proof_off: bool
    oscillated: bool
    friction: bool
    slack: bool


class Boot(NamedTuple):
    """The version of the program that the board runs, sent within a second of its start and once a second. It is the version that --version prints, without the commit's time. Boards older than supercoil 0.2.0, and the first builds of 0.2.0, do not send it."""

    time_s: float  # when it was on the bus, by the receiver's clock
    version_major: int
    version_minor: int
    version_patch: int
    commit: int


class Joint(NamedTuple):
    """The joint and both of its heaters, one part in each frame, in turn. Sent by the agonist's node or, where a spring or gravity pulls one muscle back, by that muscle's node; such a joint has only the first four parts. Other nodes do not send it, and neither do boards older than supercoil 0.2.0 and the first builds of 0.2.0. Faults of the joint are in Emergency and Status of the same node: a fault of either muscle is reported for both."""

    time_s: float  # when it was on the bus, by the receiver's clock
    part: names.Part
    agonist_limited: bool
    agonist_slack: bool
    antagonist_limited: bool
    antagonist_slack: bool
    angle_deg: float
    reference_deg: float
    error_deg: float
    effort_W: float
    co_contraction_W: float
    agonist_coldest_C: float
    agonist_hottest_C: float
    agonist_applied_W: float
    agonist_resistance_Ohm: float
    antagonist_coldest_C: float
    antagonist_hottest_C: float
    antagonist_applied_W: float
    antagonist_resistance_Ohm: float


class TuningWrite(NamedTuple):
    """Prepares one value of a controller or estimator of this node. Nothing changes until the command controller is given with 1000 added to the place. Needs the lease, and is protected in the same way as Command. The counter continues from the last protected message."""

    time_s: float  # when it was on the bus, by the receiver's clock
    crc: int
    counter: int
    place: int
    tunable: names.Tunable
    session_low: int
    value: float


LAYOUTS = (
    Layout(Sync, 0x040, 8, 0, False, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("sync", "", 8, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("master_time_s", "s", 16, 48, Raw.unsigned, 1e-06, None, None, float),
    )),
    Layout(Emergency, 0x080, 8, 0, True, (
        Signal("fault", "", 0, 8, Raw.unsigned, 1.0, None, None, names.Fault),
        Signal("state", "", 8, 8, Raw.unsigned, 1.0, None, None, names.State),
        Signal("board_time_s", "s", 16, 48, Raw.unsigned, 1e-06, None, None, float),
    )),
    Layout(FirstCause, 0x0c0, 8, 0, True, (
        Signal("measured", "", 0, 32, Raw.floating, 1.0, None, None, float),
        Signal("limit", "", 32, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(Knot, 0x100, 8, 0, False, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("after_s", "s", 12, 12, Raw.unsigned, 0.001, 4095, None, float),
        Signal("position_m", "m", 24, 24, Raw.signed, 1e-07, -8388608, None, float),
        Signal("velocity_m_per_s", "m/s", 48, 16, Raw.signed, 1e-05, -32768, None, float),
    )),
    Layout(Play, 0x140, 8, 0, False, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("when", "", 12, 4, Raw.unsigned, 1.0, None, None, names.When),
        Signal("session", "", 16, 16, Raw.unsigned, 1.0, None, None, int),
        Signal("sync", "", 32, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("after_s", "s", 40, 24, Raw.unsigned, 1e-05, None, None, float),
    )),
    Layout(Trajectory, 0x180, 8, 0, True, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("answers", "", 12, 4, Raw.unsigned, 1.0, None, None, names.Answers),
        Signal("session_low", "", 16, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("refusal", "", 24, 8, Raw.unsigned, 1.0, None, None, names.Refusal),
        Signal("playback", "", 32, 8, Raw.unsigned, 1.0, None, None, names.Playback),
        Signal("room", "", 40, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("buffered_s", "s", 48, 16, Raw.unsigned, 0.01, 65535, None, float),
    )),
    Layout(TuningRead, 0x1c0, 2, 0, False, (
        Signal("place", "", 0, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("set", "", 4, 4, Raw.unsigned, 1.0, None, None, names.Set),
        Signal("tunable", "", 8, 8, Raw.unsigned, 1.0, None, None, names.Tunable),
    )),
    Layout(Command, 0x200, 8, 0, False, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("opcode", "", 12, 4, Raw.unsigned, 1.0, None, None, names.Opcode),
        Signal("session", "", 16, 16, Raw.unsigned, 1.0, None, None, int),
        Signal("value", "", 32, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(Acknowledge, 0x240, 7, 0, True, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("opcode", "", 12, 4, Raw.unsigned, 1.0, None, None, names.Opcode),
        Signal("session", "", 16, 16, Raw.unsigned, 1.0, None, None, int),
        Signal("refusal", "", 32, 8, Raw.unsigned, 1.0, None, None, names.Refusal),
        Signal("granted", "", 40, 16, Raw.unsigned, 1.0, None, None, int),
    )),
    Layout(Measurement, 0x280, 8, 10, True, (
        Signal("position_m", "m", 0, 24, Raw.signed, 1e-07, -8388608, None, float),
        Signal("resistance_Ohm", "Ohm", 24, 24, Raw.unsigned, 0.001, 16777215, None, float),
        Signal("resistance_age_s", "s", 48, 16, Raw.unsigned, 0.01, 65535, None, float),
    )),
    Layout(Tracking, 0x2c0, 8, 10, True, (
        Signal("reference_m", "m", 0, 24, Raw.signed, 1e-07, -8388608, None, float),
        Signal("model_m", "m", 24, 24, Raw.signed, 1e-07, -8388608, None, float),
        Signal("error_m", "m", 48, 16, Raw.signed, 1e-06, -32768, None, float),
    )),
    Layout(Power, 0x300, 7, 20, True, (
        Signal("demanded_W", "W", 0, 24, Raw.signed, 0.0002, -8388608, None, float),
        Signal("applied_W", "W", 24, 24, Raw.signed, 0.0002, -8388608, None, float),
        Signal("limited_by", "", 48, 4, Raw.unsigned, 1.0, None, None, names.LimitedBy),
        Signal("limited", "", 52, 1, Raw.unsigned, 1.0, None, None, bool),
    )),
    Layout(Heater, 0x340, 7, 50, True, (
        Signal("supply_V", "V", 0, 16, Raw.unsigned, 0.001, 65535, None, float),
        Signal("current_A", "A", 16, 24, Raw.signed, 1e-05, -8388608, None, float),
        Signal("duty", "", 40, 16, Raw.unsigned, 2e-05, 65535, None, float),
    )),
    Layout(Temperature, 0x380, 4, 100, True, (
        Signal("coldest_C", "degC", 0, 16, Raw.signed, 0.01, -32768, None, float),
        Signal("hottest_C", "degC", 16, 16, Raw.signed, 0.01, -32768, None, float),
    )),
    Layout(Estimate, 0x3c0, 8, 100, True, (
        Signal("parameter", "", 0, 8, Raw.unsigned, 1.0, None, None, names.Parameter),
        Signal("trusted", "", 8, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("identify_notes", "", 9, 7, Raw.unsigned, 1.0, None, None, int),
        Signal("error_bound", "", 16, 16, Raw.unsigned, 0.0001, 65535, None, float),
        Signal("theta1", "m", 32, 32, Raw.floating, 1.0, None, 0, float),
        Signal("theta2", "W s2/m", 32, 32, Raw.floating, 1.0, None, 1, float),
        Signal("theta3", "W s/m", 32, 32, Raw.floating, 1.0, None, 2, float),
        Signal("theta4", "W/m", 32, 32, Raw.floating, 1.0, None, 3, float),
        Signal("thermal_mass_J_per_K", "J/K", 32, 32, Raw.floating, 1.0, None, 4, float),
        Signal("heat_transfer_W_per_K", "W/K", 32, 32, Raw.floating, 1.0, None, 5, float),
        Signal("stiffness_N_per_m", "N/m", 32, 32, Raw.floating, 1.0, None, 6, float),
        Signal("damping_Ns_per_m", "Ns/m", 32, 32, Raw.floating, 1.0, None, 7, float),
        Signal("bias_W", "W", 32, 32, Raw.floating, 1.0, None, 8, float),
        Signal("theta1_deviation", "m", 32, 32, Raw.floating, 1.0, None, 9, float),
        Signal("theta2_deviation", "W s2/m", 32, 32, Raw.floating, 1.0, None, 10, float),
        Signal("theta3_deviation", "W s/m", 32, 32, Raw.floating, 1.0, None, 11, float),
        Signal("theta4_deviation", "W/m", 32, 32, Raw.floating, 1.0, None, 12, float),
        Signal("bias_deviation_W", "W", 32, 32, Raw.floating, 1.0, None, 13, float),
    )),
    Layout(Margin, 0x400, 7, 50, True, (
        Signal("fault", "", 0, 8, Raw.unsigned, 1.0, None, None, names.Fault),
        Signal("used", "", 8, 16, Raw.unsigned, 0.001, 65535, None, float),
        Signal("measured", "", 24, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(Limit, 0x440, 5, 100, True, (
        Signal("fault", "", 0, 8, Raw.unsigned, 1.0, None, None, names.Fault),
        Signal("limit", "", 8, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(Timing, 0x480, 8, 100, True, (
        Signal("late_s", "s", 0, 20, Raw.unsigned, 1e-07, 1048575, None, float),
        Signal("execution_s", "s", 20, 20, Raw.unsigned, 1e-07, 1048575, None, float),
        Signal("overruns", "", 40, 12, Raw.unsigned, 1.0, None, None, int),
        Signal("dropped_frames", "", 52, 12, Raw.unsigned, 1.0, None, None, int),
    )),
    Layout(Gain, 0x4c0, 5, 200, True, (
        Signal("gain", "", 0, 8, Raw.unsigned, 1.0, None, None, names.Gain),
        Signal("value", "", 8, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(RefusedValue, 0x500, 8, 0, True, (
        Signal("value", "", 0, 32, Raw.floating, 1.0, None, None, float),
        Signal("nearest", "", 32, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(Muscle, 0x540, 5, 0, True, (
        Signal("quantity", "", 0, 8, Raw.unsigned, 1.0, None, None, names.Quantity),
        Signal("value", "", 8, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(Setting, 0x580, 8, 0, True, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("setting", "", 12, 4, Raw.unsigned, 1.0, None, None, names.Setting),
        Signal("refusal", "", 16, 8, Raw.unsigned, 1.0, None, None, names.Refusal),
        Signal("session_low", "", 24, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("value", "", 32, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(SettingWrite, 0x5c0, 8, 0, False, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("setting", "", 12, 4, Raw.unsigned, 1.0, None, None, names.Setting),
        Signal("session", "", 16, 16, Raw.unsigned, 1.0, None, None, int),
        Signal("value", "", 32, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(SettingRead, 0x600, 1, 0, False, (
        Signal("setting", "", 0, 4, Raw.unsigned, 1.0, None, None, names.Setting),
    )),
    Layout(MuscleRead, 0x680, 1, 0, False, (
        Signal("quantity", "", 0, 8, Raw.unsigned, 1.0, None, None, names.Quantity),
    )),
    Layout(Tuning, 0x640, 8, 0, True, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("place", "", 12, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("tunable", "", 16, 8, Raw.unsigned, 1.0, None, None, names.Tunable),
        Signal("refusal", "", 24, 4, Raw.unsigned, 1.0, None, None, names.Refusal),
        Signal("set", "", 28, 4, Raw.unsigned, 1.0, None, None, names.Set),
        Signal("value", "", 32, 32, Raw.floating, 1.0, None, None, float),
    )),
    Layout(Status, 0x700, 8, 100, True, (
        Signal("state", "", 0, 4, Raw.unsigned, 1.0, None, None, names.State),
        Signal("mode", "", 4, 4, Raw.unsigned, 1.0, None, None, names.Mode),
        Signal("fault", "", 8, 8, Raw.unsigned, 1.0, None, None, names.Fault),
        Signal("limited_by", "", 16, 4, Raw.unsigned, 1.0, None, None, names.LimitedBy),
        Signal("probing", "", 20, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("trusted", "", 21, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("limited", "", 22, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("leased", "", 23, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("controller", "", 24, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("progress", "", 32, 8, Raw.unsigned, 0.005, 255, None, float),
        Signal("counter", "", 40, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("protocol_version", "", 48, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("result", "", 56, 4, Raw.unsigned, 1.0, None, None, names.Result),
        Signal("proof_off", "", 60, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("oscillated", "", 61, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("friction", "", 62, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("slack", "", 63, 1, Raw.unsigned, 1.0, None, None, bool),
    )),
    Layout(Boot, 0x740, 8, 1000, True, (
        Signal("version_major", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("version_minor", "", 8, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("version_patch", "", 16, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("commit", "", 32, 28, Raw.unsigned, 1.0, None, None, int),
    )),
    Layout(Joint, 0x780, 8, 20, True, (
        Signal("part", "", 0, 4, Raw.unsigned, 1.0, None, None, names.Part),
        Signal("agonist_limited", "", 4, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("agonist_slack", "", 5, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("antagonist_limited", "", 6, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("antagonist_slack", "", 7, 1, Raw.unsigned, 1.0, None, None, bool),
        Signal("angle_deg", "deg", 8, 20, Raw.signed, 0.0005, -524288, None, float),
        Signal("reference_deg", "deg", 28, 20, Raw.signed, 0.0005, -524288, 0, float),
        Signal("error_deg", "deg", 48, 16, Raw.signed, 0.0005, -32768, 0, float),
        Signal("effort_W", "W", 28, 18, Raw.signed, 0.001, -131072, 1, float),
        Signal("co_contraction_W", "W", 46, 18, Raw.unsigned, 0.001, 262143, 1, float),
        Signal("agonist_coldest_C", "degC", 28, 16, Raw.signed, 0.01, -32768, 2, float),
        Signal("agonist_hottest_C", "degC", 44, 16, Raw.signed, 0.01, -32768, 2, float),
        Signal("agonist_applied_W", "W", 28, 17, Raw.unsigned, 0.001, 131071, 3, float),
        Signal("agonist_resistance_Ohm", "Ohm", 45, 19, Raw.unsigned, 0.01, 524287, 3, float),
        Signal("antagonist_coldest_C", "degC", 28, 16, Raw.signed, 0.01, -32768, 4, float),
        Signal("antagonist_hottest_C", "degC", 44, 16, Raw.signed, 0.01, -32768, 4, float),
        Signal("antagonist_applied_W", "W", 28, 17, Raw.unsigned, 0.001, 131071, 5, float),
        Signal("antagonist_resistance_Ohm", "Ohm", 45, 19, Raw.unsigned, 0.01, 524287, 5, float),
    )),
    Layout(TuningWrite, 0x6c0, 8, 0, False, (
        Signal("crc", "", 0, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("counter", "", 8, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("place", "", 12, 4, Raw.unsigned, 1.0, None, None, int),
        Signal("tunable", "", 16, 8, Raw.unsigned, 1.0, None, None, names.Tunable),
        Signal("session_low", "", 24, 8, Raw.unsigned, 1.0, None, None, int),
        Signal("value", "", 32, 32, Raw.floating, 1.0, None, None, float),
    )),
)

# Identifiers are base + node.
SYNC = 0x040
EMERGENCY = 0x080
FIRST_CAUSE = 0x0c0
KNOT = 0x100
PLAY = 0x140
TRAJECTORY = 0x180
TUNING_READ = 0x1c0
COMMAND = 0x200
ACKNOWLEDGE = 0x240
MEASUREMENT = 0x280
TRACKING = 0x2c0
POWER = 0x300
HEATER = 0x340
TEMPERATURE = 0x380
ESTIMATE = 0x3c0
MARGIN = 0x400
LIMIT = 0x440
TIMING = 0x480
GAIN = 0x4c0
REFUSED_VALUE = 0x500
MUSCLE = 0x540
SETTING = 0x580
SETTING_WRITE = 0x5c0
SETTING_READ = 0x600
MUSCLE_READ = 0x680
TUNING = 0x640
STATUS = 0x700
BOOT = 0x740
JOINT = 0x780
TUNING_WRITE = 0x6c0
