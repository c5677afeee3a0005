"""The lines of the board's socket, translated to the protocol's terms (docs/running.md)."""

import math
from collections.abc import Iterator, Mapping

from supercoil import codec
from supercoil.codec import FORGET, FORGET_TUNING, RISES_FROM, STORE, STORE_TUNING, TUNES_FROM
from supercoil.generated import messages, results
from supercoil.generated.names import Fault, Mode, Opcode, Parameter, Playback, Result, State
from supercoil.generated.version import PROTOCOL_VERSION

_STORE = {FORGET: "clear", STORE: "store", STORE_TUNING: "store tuning", FORGET_TUNING: "clear tuning"}
_WITH_VALUE = (Opcode.position, Opcode.power, Opcode.scale, Opcode.controller, Opcode.estimator)


def command_line(opcode: Opcode, value: float) -> str:
    """The line without the channel."""
    if opcode == Opcode.compare:
        if value >= RISES_FROM:
            return f"compare_rise {value - RISES_FROM:.9g}"
        return f"compare_current {-value:.9g}" if value < 0.0 else f"compare_supply {value:.9g}"
    if opcode == Opcode.store:
        return _STORE[value]
    if opcode == Opcode.controller and value >= TUNES_FROM:
        return f"tune {value - TUNES_FROM:.9g}"
    return f"{opcode} {value:.9g}" if opcode in _WITH_VALUE else str(opcode)


def _notes(word: str) -> int:
    names = word.split(",")
    return sum(1 << bit for bit, name in enumerate(results.NOTES) if name in names)


def trajectory_of(words: list[str]) -> messages.Trajectory:
    """From a channel's line of "playback", without the board's time at its end."""
    values = {"playback": Playback[words[0]], "room": int(words[1]), "buffered_s": float(words[2])}
    decoded = codec.decode(messages.TRAJECTORY, codec.encode(codec.LAYOUTS[messages.TRAJECTORY], values))
    assert isinstance(decoded, messages.Trajectory)
    return decoded


def frames_of(words: list[str], *, probing: bool) -> Iterator[tuple[int, Mapping[str, float]]]:
    """From a channel's line of "state", as the values of frames. What the socket does not report is not available."""
    state, mode, fault = State[words[0]], Mode[words[1]], Fault[words[2]]
    reference, model, position, applied, coldest, hottest, progress = map(float, words[3:10])
    notes = _notes(words[11])
    nan = math.nan
    follows = state == State.active and mode == Mode.position
    yield messages.MEASUREMENT, {"position_m": position, "resistance_Ohm": nan, "resistance_age_s": nan}
    yield messages.TRACKING, {"reference_m": reference if follows else nan, "model_m": model if follows else nan,
                              "error_m": position - model if follows else nan}
    yield messages.POWER, {"demanded_W": reference if mode == Mode.power else nan, "applied_W": applied}
    yield messages.TEMPERATURE, {"coldest_C": coldest, "hottest_C": hottest}
    yield messages.ESTIMATE, {"parameter": Parameter.theta1, "theta1": nan, "error_bound": nan,
                              "identify_notes": notes & 0x7F}
    yield messages.STATUS, {"state": state, "mode": mode, "fault": fault, "probing": probing, "progress": progress,
                            "protocol_version": PROTOCOL_VERSION, "result": Result[words[10]], "friction": notes >> 7,
                            "slack": int(words[14:15] == ["slack"])}
