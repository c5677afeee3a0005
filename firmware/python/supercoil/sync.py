"""The same without asyncio: every call here waits for the call of that name in supercoil.Muscle."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

import can

from supercoil import muscle as asynchronous
from supercoil.commands import Order
from supercoil.cycles import cycle as async_cycle
from supercoil.discovery import Found
from supercoil.discovery import discover as async_discover
from supercoil.discovery import stop as async_stop
from supercoil.generated import messages
from supercoil.generated.names import Fault, Quantity, Setting, State
from supercoil.joints import Joint
from supercoil.learning import Outcome
from supercoil.player import Motion
from supercoil.playing import play as async_play
from supercoil.portal import run
from supercoil.recording import Recording
from supercoil.simulation import Simulation as AsyncSimulation
from supercoil.telemetry import Telemetry
from supercoil.tuning import Tuned

M = TypeVar("M", bound=tuple[Any, ...])


class Muscle:
    """with sync.Muscle("can0", node=1) as muscle: ... It is disarmed at the end of the block."""

    def __init__(self, address: str | can.BusABC, node: int = 1, *, deadline_s: float = 2.0, **options: object) -> None:
        self._muscle = asynchronous.Muscle(address, node, deadline_s=deadline_s, **options)

    @classmethod
    def of(cls, muscle: "asynchronous.Muscle") -> Self:
        """A synchronous face of the muscle, whether it is connected or not."""
        made = cls.__new__(cls)
        made._muscle = muscle
        return made

    @property
    def node(self) -> int:
        return self._muscle.node

    @property
    def deadline_s(self) -> float:
        return self._muscle.deadline_s

    def connect(self) -> Self:
        run(self._muscle.connect())
        return self

    def close(self) -> None:
        run(self._muscle.close())

    def __enter__(self) -> Self:
        return self.connect()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        run(self._muscle.__aexit__(kind, error, trace))

    @property
    def telemetry(self) -> Telemetry:
        return self._muscle.telemetry

    @property
    def state(self) -> State:
        return self._muscle.state

    @property
    def fault(self) -> Fault:
        return self._muscle.fault

    @property
    def position_m(self) -> float:
        return self._muscle.position_m

    def record(self, *kinds: type[Any] | str, most_frames: int | None = None) -> Recording:
        return self._muscle.record(*kinds, most_frames=most_frames)

    def stream(self, kind: type[M]) -> Iterator[M]:
        stream = self._muscle.stream(kind)

        async def one() -> M:
            return await anext(stream)

        try:
            while True:
                yield run(one())
        finally:
            run(stream.aclose())

    def arm(self, timeout_s: float = 5.0) -> None:
        run(self._muscle.arm(timeout_s))

    def disarm(self) -> None:
        run(self._muscle.disarm())

    def reset(self) -> None:
        run(self._muscle.reset())

    def set_position(self, position_m: float) -> None:
        run(self._muscle.set_position(position_m))

    def set_power(self, power_W: float) -> None:
        run(self._muscle.set_power(power_W))

    def move_to(self, position_m: float, *, tolerance_m: float = 2e-4, timeout_s: float = 30.0) -> None:
        run(self._muscle.move_to(position_m, tolerance_m=tolerance_m, timeout_s=timeout_s))

    def hold(self, seconds: float) -> None:
        run(self._muscle.hold(seconds))

    def rest(self) -> None:
        run(self._muscle.rest())

    def renew(self) -> None:
        run(self._muscle.renew())

    def identify(self, timeout_s: float = 3600.0) -> Outcome:
        return run(self._muscle.identify(timeout_s))

    def calibrate(self, timeout_s: float = 600.0) -> Outcome:
        return run(self._muscle.calibrate(timeout_s))

    def scale(self, true_position_m: float) -> None:
        run(self._muscle.scale(true_position_m))

    def store(self) -> None:
        run(self._muscle.store())

    def forget(self) -> None:
        run(self._muscle.forget())

    def use_controller(self, place: int) -> None:
        run(self._muscle.use_controller(place))

    def use_estimator(self, place: int) -> None:
        run(self._muscle.use_estimator(place))

    def compare_supply(self, volts: float) -> None:
        run(self._muscle.compare_supply(volts))

    def compare_current(self, amperes: float) -> None:
        run(self._muscle.compare_current(amperes))

    def compare_rise(self, kelvins: float) -> None:
        run(self._muscle.compare_rise(kelvins))

    def tuning(self, controller: int = 0, *, estimator: int | None = None) -> dict[str, Tuned]:
        return run(self._muscle.tuning(controller, estimator=estimator))

    def tune(self, controller: int = 0, *, estimator: int | None = None, base: str = "in_use",
             **values: float | str) -> None:
        run(self._muscle.tune(controller, estimator=estimator, base=base, **values))

    def prepare(self, controller: int = 0, *, estimator: int | None = None, base: str = "in_use",
                **values: float | str) -> None:
        run(self._muscle.prepare(controller, estimator=estimator, base=base, **values))

    def take_over(self, controller: int = 0, *, estimator: int | None = None) -> None:
        run(self._muscle.take_over(controller, estimator=estimator))

    def store_tuning(self) -> None:
        run(self._muscle.store_tuning())

    def forget_tuning(self) -> None:
        run(self._muscle.forget_tuning())

    def setting(self, setting: Setting | str) -> float:
        return run(self._muscle.setting(setting))

    def settings(self) -> dict[Setting, float]:
        return run(self._muscle.settings())

    def change(self, setting: Setting | str, value: float) -> float:
        return run(self._muscle.change(setting, value))

    def program(self) -> str:
        return run(self._muscle.program())

    def quantities(self) -> dict[Quantity, float]:
        return run(self._muscle.quantities())

    def joint(self) -> Joint | None:
        return run(self._muscle.joint())

    def make_position(self, position_m: float) -> Order:
        return self._muscle.make_position(position_m)

    def make_power(self, power_W: float) -> Order:
        return self._muscle.make_power(power_W)

    def make_renew(self) -> Order:
        return self._muscle.make_renew()

    def make_rest(self) -> Order:
        return self._muscle.make_rest()

    def play(self, times_s: Iterable[float], positions_m: Iterable[float],
             velocities_m_per_s: Iterable[float] | None = None, *, settle_s: float = 3.0, hold: bool = False) -> None:
        run(self._muscle.play(times_s, positions_m, velocities_m_per_s, settle_s=settle_s, hold=hold))

    def make_motion(self, times_s: Iterable[float], positions_m: Iterable[float],
                    velocities_m_per_s: Iterable[float] | None = None) -> Motion:
        return self._muscle.make_motion(times_s, positions_m, velocities_m_per_s)

    def execute(self, order: Order) -> messages.Measurement:
        return run(self._muscle.execute(order))


class Simulation:
    """with sync.Simulation("bench") as simulation: simulation.muscle.arm() ..."""

    def __init__(self, scenario: str | Path = "bench", *, node: int = 1, deadline_s: float = 2.0,
                 folder: str | Path | None = None, options: tuple[str, ...] = ()) -> None:
        self._simulation = AsyncSimulation(scenario, node=node, deadline_s=deadline_s, folder=folder, options=options)

    @classmethod
    def of(cls, simulation: AsyncSimulation) -> Self:
        """A synchronous face of the simulation, whether it is started or not."""
        made = cls.__new__(cls)
        made._simulation = simulation
        return made

    @property
    def muscle(self) -> Muscle:
        return Muscle.of(self._simulation.muscle)

    @property
    def address(self) -> str:
        return self._simulation.address

    @property
    def scenario(self) -> str:
        return self._simulation.scenario

    def start(self) -> Self:
        run(self._simulation.start())
        return self

    def stop(self) -> None:
        run(self._simulation.stop())

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.stop()


def cycle(orders: Sequence[Order]) -> list[messages.Measurement]:
    return run(async_cycle(orders))


def play(motions: Sequence[Motion], *, settle_s: float = 3.0, hold: bool = False) -> None:
    run(async_play(motions, settle_s=settle_s, hold=hold))


def discover(address: str | can.BusABC, *, seconds: float = 1.0, **options: object) -> list[Found]:
    return run(async_discover(address, seconds=seconds, **options))


def stop(address: str | can.BusABC, node: int = 1, **options: object) -> None:
    run(async_stop(address, node, **options))
