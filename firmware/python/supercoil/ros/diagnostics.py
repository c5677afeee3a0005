"""The state of each joint, for rqt_robot_monitor and other readers of /diagnostics."""

from collections.abc import Sequence
from typing import Any

from supercoil.generated import faults, messages
from supercoil.generated.names import Fault, State
from supercoil.muscle import Muscle
from supercoil.ros.joint import Joint
from supercoil.ros.messages import ERROR, OK, STALE, WARN, DiagnosticArray, DiagnosticStatus, Header, KeyValue, Time

# The values of the newest messages that are shown.
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
        newest = muscle.telemetry.newest(kind)
        if newest is None:
            continue
        for name in shown:
            value = getattr(newest, name)
            values.append(KeyValue(name, f"{value:.7g}" if isinstance(value, float) else str(value)))
    return values


def _angles(joint: Joint) -> list[KeyValue]:
    """For a joint that turns: its muscle's values, as angles of the joint."""
    if not joint.turns or joint.muscle is None:
        return []
    values = [KeyValue("position_rad", f"{joint.position:.7g}")]
    tracking = joint.muscle.telemetry.newest(messages.Tracking)
    if tracking is not None:
        values.append(KeyValue("reference_rad", f"{joint.of_m(tracking.reference_m):.7g}"))
    return values


def _judged(muscle: Muscle, refusal: str, otherwise: str) -> tuple[int, str]:
    fault = muscle.fault
    if fault != Fault.none:
        known = faults.BY_NUMBER.get(fault)
        return ERROR, f"fault {fault}: {known.meaning}" if known else f"fault {fault}"
    if refusal:
        return WARN, refusal
    power = muscle.telemetry.newest(messages.Power)
    if muscle.state == State.active and power is not None and power.limited:
        return WARN, f"follows, but power is limited by {power.limited_by}"
    return OK, otherwise


def _led(muscle: Muscle, joint_node: int | None) -> str:
    return f"{muscle.state}, antagonist in the joint of node {joint_node}"


def _doing(joint: Joint, muscle: Muscle) -> str:
    if joint.pair is not None and joint.is_led:
        return _led(muscle, joint.pair.other_node)
    if joint.set_point is not None:
        return f"follows, set point {joint.set_point:.6f} {joint.unit}"
    return str(muscle.state)


def _status_of(joint: Joint) -> DiagnosticStatus:
    name = f"supercoil: {joint.name}"
    muscle = joint.muscle
    if muscle is None:
        return DiagnosticStatus(STALE, name, joint.problem, joint.hardware_id)
    level, message = _judged(muscle, joint.refusal, _doing(joint, muscle))
    return DiagnosticStatus(level, name, message, joint.hardware_id, [*_angles(joint), *_values(muscle)])


def _status_of_antagonist(joint: Joint, node: int) -> DiagnosticStatus:
    """Its power shows how hard both pull."""
    name, hardware_id = f"supercoil: {joint.name} antagonist", f"{joint.address} node {node}"
    muscle = joint.antagonist
    if muscle is None:
        return DiagnosticStatus(STALE, name, "not connected", hardware_id)
    level, message = _judged(muscle, "", _led(muscle, joint.node))
    return DiagnosticStatus(level, name, message, hardware_id, _values(muscle))


def diagnostics_of(joints: Sequence[Joint], stopped: bool) -> DiagnosticArray:
    level, message = (ERROR, "stopped") if stopped else (OK, "released")
    stop = DiagnosticStatus(level, "supercoil: emergency stop", message)
    named = {joint.node for joint in joints}
    antagonists = [_status_of_antagonist(joint, node) for joint in joints
                   if (node := joint.antagonist_node) is not None and node not in named]
    return DiagnosticArray(Header(Time.now()), [stop, *(_status_of(joint) for joint in joints), *antagonists])
