"""The options of supercoil-ros: names of ROS, rates, times."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Options:
    node: str = "supercoil"
    domain: int = 0
    rate_Hz: float = 100.0
    command_timeout_s: float = 1.0
    states: str = "/joint_states"
    commands: str = "~/joint_commands"
    trajectory: str = "~/joint_trajectory"
    arm: bool = False
