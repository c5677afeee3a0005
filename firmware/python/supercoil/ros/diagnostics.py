"""How each joint is, for rqt_robot_monitor and whoever else reads /diagnostics."""

from collections.abc import Sequence
from typing import Any

from supercoil.generated import faults, messages
from supercoil.generated.names import Fault, State
from supercoil.muscle import Muscle
from supercoil.ros.joint import Joint
from supercoil.ros.messages import ERROR, OK, STALE, WARN, DiagnosticArray, DiagnosticStatus, Header, KeyValue, Time

# Which values of the newest messages are shown.
_SHOWN: dict[type[Any], tuple[str, ...]] = {
    messages.Status: ("state", "mode", "fault", "leased"),
    messages.Measurement: ("position_m", "resistance_Ohm"),
    messages.Tracking: ("reference_m", "error_m"),
    messages.Power: ("demanded_W", "applied_W", "limited_by"),
    messages.Heater: ("supply_V", "current_A", "duty"),
    messages.Temperature: ("coldest_C", "hottest_C"),
}


def _values(muscle: Muscle) -> list[KeyValue]:
    values = []
    for kind, shown in _SHOWN.items():
        told = muscle.telemetry.newest(kind)
        if told is None:
            continue
        for name in shown:
            value = getattr(told, name)
            values.append(KeyValue(name, f"{value:.7g}" if isinstance(value, float) else str(value)))
    return values


def _judged(joint: Joint, muscle: Muscle) -> tuple[int, str]:
    fault = muscle.fault
    if fault != Fault.none:
        known = faults.BY_NUMBER.get(fault)
        return ERROR, f"fault {fault}: {known.meaning}" if known else f"fault {fault}"
    if joint.refusal:
        return WARN, joint.refusal
    power = muscle.telemetry.newest(messages.Power)
    if muscle.state == State.active and power is not None and power.limited:
        return WARN, f"follows, but power is limited by {power.limited_by}"
    if joint.set_point_m is not None:
        return OK, f"follows, set point {joint.set_point_m:.6f} m"
    return OK, str(muscle.state)


def _status_of(joint: Joint) -> DiagnosticStatus:
    name = f"supercoil: {joint.name}"
    muscle = joint.muscle
    if muscle is None:
        return DiagnosticStatus(STALE, name, joint.problem.splitlines()[0], joint.hardware_id)
    level, message = _judged(joint, muscle)
    return DiagnosticStatus(level, name, message, joint.hardware_id, _values(muscle))


def diagnostics_of(joints: Sequence[Joint], stopped: bool) -> DiagnosticArray:
    level, message = (ERROR, "stopped") if stopped else (OK, "released")
    stop = DiagnosticStatus(level, "supercoil: emergency stop", message)
    return DiagnosticArray(Header(Time.now()), [stop, *(_status_of(joint) for joint in joints)])
