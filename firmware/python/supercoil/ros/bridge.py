"""Connects ROS 2 and the boards: takes commands and publishes states, at a fixed rate in one task.

If this task hangs, commands are no longer renewed, and the boards let the muscles cool by themselves.
"""

import asyncio
import functools
import logging
import math
import time
from collections.abc import Awaitable, Callable, Sequence

from supercoil.errors import SupercoilError
from supercoil.generated.names import State
from supercoil.ros.diagnostics import diagnostics_of
from supercoil.ros.graph import Graph
from supercoil.ros.joint import Joint, reason_of
from supercoil.ros.messages import Bool, DiagnosticArray, Header, JointState, JointTrajectory, Time
from supercoil.ros.motion import Held, Knot, Trajectory, knots_of
from supercoil.ros.names import resolved
from supercoil.ros.options import Options

_DIAGNOSTICS_PERIOD_S = 1.0
_log = logging.getLogger("supercoil.ros")


class Bridge:
    def __init__(self, joints: Sequence[Joint], options: Options) -> None:
        self._joints = {joint.name: joint for joint in joints}
        self._options = options
        self._stopped = False
        self._armed_once: set[str] = set()
        self._aside: dict[str, asyncio.Task[None]] = {}
        graph = Graph(options.domain)
        name = functools.partial(resolved, node=options.node)
        self._states = graph.publisher(name(options.states), JointState)
        self._diagnostics = graph.publisher("/diagnostics", DiagnosticArray)
        self._commands = graph.subscription(name(options.commands), JointState, (False,))
        self._trajectories = graph.subscription(name(options.trajectory), JointTrajectory, (True,))
        self._stop = graph.subscription(name("~/emergency_stop"), Bool, (True, False))
        self._services = []
        for verb, do in (("arm", Joint.arm), ("disarm", Joint.disarm), ("reset", Joint.reset)):
            self._services.append(graph.service(name(f"~/{verb}"), functools.partial(self._serve_all, do)))
            for joint in joints:
                one = functools.partial(self._serve, [joint], do)
                self._services.append(graph.service(name(f"~/{joint.name}/{verb}"), one))

    async def run(self) -> None:
        """Runs until it is cancelled; then disarms every muscle that was commanded."""
        async with asyncio.TaskGroup() as tasks:
            for joint in self._joints.values():
                tasks.create_task(joint.run())
            tasks.create_task(self._cycle())

    async def _cycle(self) -> None:
        loop = asyncio.get_running_loop()
        period_s = 1.0 / self._options.rate_Hz
        at_s = loop.time()
        diagnosed_s = -math.inf
        while True:
            self._take()
            now_s = time.monotonic()
            for joint in self._joints.values():
                if self._stopped:
                    self._hold_stopped(joint)
                else:
                    joint.follow(now_s)
            self._publish_states()
            if loop.time() - diagnosed_s >= _DIAGNOSTICS_PERIOD_S:
                diagnosed_s = loop.time()
                self._diagnostics.write(diagnostics_of(list(self._joints.values()), self._stopped))
                self._arm_at_start()
            at_s = max(at_s + period_s, loop.time())  # missed periods are left out
            await asyncio.sleep(at_s - loop.time())

    def _publish_states(self) -> None:
        """Velocity and effort are not measured, so they stay empty."""
        joints = self._own_joints()
        self._states.write(JointState(Header(Time.now()), [joint.name for joint in joints],
                                      [joint.position for joint in joints]))

    def _own_joints(self) -> list[Joint]:
        """All joints but muscles that turn another one's joint back."""
        return [joint for joint in self._joints.values() if not joint.is_led]

    def _take(self) -> None:
        for stop, _ in self._stop.take():
            self._emergency_stop(stop.data)
        for service in self._services:
            service.serve()
        for command, _ in self._commands.take():
            self._command(command)
        for trajectory, publisher in self._trajectories.take():
            self._follow(trajectory, functools.partial(self._trajectories.has, publisher))

    def _emergency_stop(self, stop: bool) -> None:
        if stop != self._stopped:
            _log.warning("emergency stop: %s", "stopped" if stop else "released; arm to go on")
        self._stopped = stop
        for joint in self._joints.values() if stop else ():
            joint.let_go()
            self._run_aside(joint, joint.disarm)  # whatever its heartbeat says

    def _hold_stopped(self, joint: Joint) -> None:
        """Disarms it, again and again while it is armed by a command that was under way or by another master."""
        joint.let_go()
        if joint.muscle is not None and joint.muscle.state in (State.armed, State.active):
            self._run_aside(joint, joint.disarm)

    def _run_aside(self, joint: Joint, do: Callable[[], Awaitable[str]]) -> None:
        """Unless the same action is under way for this joint."""
        async def run() -> None:
            try:
                await do()
            except (SupercoilError, RuntimeError) as error:  # RuntimeError: the connection has just been closed
                joint.refuse(reason_of(error))

        name = f"{joint.name} {do.__name__}"
        if name not in self._aside:
            task = self._aside[name] = asyncio.create_task(run())
            task.add_done_callback(lambda _: self._aside.pop(name))

    def _arm_at_start(self) -> None:
        """Arms each joint once, when its board is first reached."""
        for joint in self._own_joints() if self._options.arm else ():
            if joint.muscle is not None and joint.name not in self._armed_once and not self._stopped:
                self._armed_once.add(joint.name)
                self._run_aside(joint, joint.arm)

    def _command(self, command: JointState) -> None:
        """Takes the positions of our joints from the command."""
        if self._stopped or not command.position:
            return
        until_s = time.monotonic() + self._options.command_timeout_s
        ours = [(self._joints[name], number) for number, name in enumerate(command.name) if name in self._joints]
        for joint, number in ours:
            if len(command.position) != len(command.name):
                joint.refuse(f"a command has {len(command.position)} positions for {len(command.name)} names")
                continue
            position = command.position[number]
            if math.isfinite(position):
                joint.motion = Held(position, until_s)
            else:
                joint.refuse(f"a command of {position} {joint.unit} is ignored")

    def _follow(self, trajectory: JointTrajectory, sender_is_there: Callable[[], bool]) -> None:
        """Takes the trajectory for all of its joints, or for none."""
        if self._stopped:
            return
        try:
            knots = self._knots_of(trajectory)
        except ValueError as error:
            _log.warning("a trajectory is refused: %s", error)
            for name in trajectory.joint_names:
                if name in self._joints:
                    self._joints[name].refuse(f"a trajectory is refused: {error}")
            return
        for name, path in knots.items():
            self._joints[name].motion = Trajectory(path, sender_is_there)

    def _knots_of(self, trajectory: JointTrajectory) -> dict[str, list[Knot]]:
        knots: dict[str, list[Knot]] = {}
        for name in trajectory.joint_names:
            if name not in self._joints:
                names = (joint.name for joint in self._own_joints())
                raise ValueError(f"no joint is called {name!r}; there are {', '.join(names)}")
            if self._joints[name].is_led:
                raise ValueError(f"{name} is the antagonist of another muscle's joint")
        for number, name in enumerate(trajectory.joint_names):
            if name in knots:
                raise ValueError(f"names {name} twice")
            joint = self._joints[name]
            position = joint.position if joint.set_point is None else joint.set_point
            if not math.isfinite(position):
                raise ValueError(f"the present position of {name} is not known")
            knots[name] = knots_of(trajectory, number, Knot(time.monotonic(), position, 0.0), time.time())
        return knots

    async def _serve_all(self, do: Callable[[Joint], Awaitable[str]]) -> tuple[bool, str]:
        """An action on one of a joint's muscles applies to both."""
        if not (joints := self._own_joints()):
            return False, "each muscle is the antagonist of another one's joint: name the agonist with --joint"
        return await self._serve(joints, do)

    async def _serve(self, joints: Sequence[Joint], do: Callable[[Joint], Awaitable[str]]) -> tuple[bool, str]:
        if self._stopped and do is Joint.arm:
            return False, "the emergency stop is set; publish false on it first"
        done = await asyncio.gather(*(do(joint) for joint in joints), return_exceptions=True)
        lines = []
        for joint, outcome in zip(joints, done, strict=True):
            if isinstance(outcome, BaseException) and not isinstance(outcome, (SupercoilError, RuntimeError)):
                raise outcome
            lines.append(f"{joint.name}: {reason_of(outcome) if isinstance(outcome, BaseException) else outcome}")
        return not any(isinstance(outcome, BaseException) for outcome in done), "; ".join(lines)
