"""Messages of ROS 2 as they are on the wire: DDS types of these names, in CDR of version 1.

Fields, order and types are those of ROS 2 Humble and Jazzy; tests compare bytes and hashes with an independent library.
"""

import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from cyclonedds.idl import IdlStruct, annotations, types

if TYPE_CHECKING:
    sequence = list  # what such a field contains
else:
    from cyclonedds.idl.types import sequence

_NS_PER_S = 1_000_000_000
OK, WARN, ERROR, STALE = range(4)  # values of DiagnosticStatus.level


@dataclass
@annotations.final
class Time(IdlStruct, typename="builtin_interfaces::msg::dds_::Time_"):
    sec: types.int32 = 0
    nanosec: types.uint32 = 0

    @classmethod
    def now(cls) -> "Time":
        return cls(*divmod(time.time_ns(), _NS_PER_S))


@dataclass
@annotations.final
class Duration(IdlStruct, typename="builtin_interfaces::msg::dds_::Duration_"):
    sec: types.int32 = 0
    nanosec: types.uint32 = 0


def in_seconds(time_or_duration: Time | Duration) -> float:
    return time_or_duration.sec + time_or_duration.nanosec / _NS_PER_S


@dataclass
@annotations.final
class Header(IdlStruct, typename="std_msgs::msg::dds_::Header_"):
    stamp: Time = field(default_factory=Time)
    frame_id: str = ""


@dataclass
@annotations.final
class Bool(IdlStruct, typename="std_msgs::msg::dds_::Bool_"):
    data: bool = False


@dataclass
@annotations.final
class JointState(IdlStruct, typename="sensor_msgs::msg::dds_::JointState_"):
    header: Header = field(default_factory=Header)
    name: sequence[str] = field(default_factory=list)
    position: sequence[types.float64] = field(default_factory=list)
    velocity: sequence[types.float64] = field(default_factory=list)
    effort: sequence[types.float64] = field(default_factory=list)


@dataclass
@annotations.final
class JointTrajectoryPoint(IdlStruct, typename="trajectory_msgs::msg::dds_::JointTrajectoryPoint_"):
    positions: sequence[types.float64] = field(default_factory=list)
    velocities: sequence[types.float64] = field(default_factory=list)
    accelerations: sequence[types.float64] = field(default_factory=list)
    effort: sequence[types.float64] = field(default_factory=list)
    time_from_start: Duration = field(default_factory=Duration)


@dataclass
@annotations.final
class JointTrajectory(IdlStruct, typename="trajectory_msgs::msg::dds_::JointTrajectory_"):
    header: Header = field(default_factory=Header)
    joint_names: sequence[str] = field(default_factory=list)
    points: sequence[JointTrajectoryPoint] = field(default_factory=list)


@dataclass
@annotations.final
class KeyValue(IdlStruct, typename="diagnostic_msgs::msg::dds_::KeyValue_"):
    key: str = ""
    value: str = ""


@dataclass
@annotations.final
class DiagnosticStatus(IdlStruct, typename="diagnostic_msgs::msg::dds_::DiagnosticStatus_"):
    level: types.byte = OK
    name: str = ""
    message: str = ""
    hardware_id: str = ""
    values: sequence[KeyValue] = field(default_factory=list)


@dataclass
@annotations.final
class DiagnosticArray(IdlStruct, typename="diagnostic_msgs::msg::dds_::DiagnosticArray_"):
    header: Header = field(default_factory=Header)
    status: sequence[DiagnosticStatus] = field(default_factory=list)


@dataclass
@annotations.final
class TriggerRequest(IdlStruct, typename="std_srvs::srv::dds_::Trigger_Request_"):
    """Begins with what rmw_cyclonedds puts before each request: its client, and its number."""

    client: types.uint64 = 0
    sequence: types.int64 = 0
    structure_needs_at_least_one_member: types.uint8 = 0


@dataclass
@annotations.final
class TriggerResponse(IdlStruct, typename="std_srvs::srv::dds_::Trigger_Response_"):
    """Answers the request of this client with this number."""

    client: types.uint64 = 0
    sequence: types.int64 = 0
    success: bool = False
    message: str = ""


# REP 2011: newer versions of ROS 2 compare these to see that both sides mean the same type.
TYPE_HASHES: dict[type[IdlStruct], str] = {
    Bool: "RIHS01_feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9",
    JointState: "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e",
    JointTrajectory: "RIHS01_179b33eba59d676f6d967ac71fe35e7ca2f64b2f3928f4a018cec115e213796e",
    DiagnosticArray: "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
}
