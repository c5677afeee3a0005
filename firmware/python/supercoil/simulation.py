"""The simulated board as a separate process in real time, and its muscle."""

import asyncio
import os
import re
import shutil
import signal
import subprocess
import tempfile
import weakref
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self

from supercoil.errors import SimulationError
from supercoil.muscle import Muscle

if TYPE_CHECKING:
    from supercoil import sync

_PROGRAM = "supercoil-sim"
_SERVING = re.compile(r"serving \S+ on 127\.0\.0\.1:(\d+) by the socketcand protocol\n")
_ENDS_WITHIN_S = 10.0


def _program() -> str:
    if found := os.environ.get("SUPERCOIL_SIM") or shutil.which(_PROGRAM):
        return found
    raise SimulationError(f"{_PROGRAM} is not on the PATH: build or install supercoil, or name it in SUPERCOIL_SIM")


def _start(command: list[str]) -> tuple["subprocess.Popen[str]", int]:
    """Starts the process; also returns the port on which it serves the board's bus."""
    try:
        # In a process session of its own: Ctrl-C reaches only this program, which then ends the simulation in order.
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
    except OSError as error:
        raise SimulationError(f"{command[0]}: {error.strerror}") from error
    assert process.stdout is not None
    if found := _SERVING.fullmatch(process.stdout.readline()):
        return process, int(found[1])
    process.kill()
    raise SimulationError(process.communicate()[1].strip() or f"{command[0]} did not say where it serves")


class Simulation:
    """async with Simulation("bench") as simulation: await simulation.muscle.arm() ...

    scenario: a name of supercoil-sim list, or the path of a TOML file. folder: for its results; without one they are
    deleted at the end. options: further ones of supercoil-sim, as on its command line. address is its bus, which other
    programs may join.
    """

    def __init__(self, scenario: str | Path = "bench", *, node: int = 1, deadline_s: float = 2.0,
                 folder: str | Path | None = None, options: tuple[str, ...] = ()) -> None:
        self.scenario = str(scenario)
        self.address = ""
        self._node = node
        self._deadline_s = deadline_s
        self._folder = folder
        self._options = options
        self._muscle: Muscle | None = None
        self._process: subprocess.Popen[str] | None = None

    @property
    def muscle(self) -> Muscle:
        if self._muscle is None:
            raise SimulationError("the simulation has not been started: use 'async with', or start()")
        return self._muscle

    async def start(self) -> Self:
        self._temporary = None if self._folder else tempfile.TemporaryDirectory(prefix="supercoil-")
        folder = str(self._folder or Path(self._temporary.name if self._temporary else "") / "out")
        try:
            process, port = await asyncio.to_thread(_start, [
                _program(), "run", self.scenario, "--real-time", "--can", "socketcand:0", "--out", folder, "--quiet",
                "--end-with-parent", *self._options])
        except BaseException:
            await self._end()
            raise
        self._process = process
        self._kill = weakref.finalize(self, process.kill)  # also when Python exits
        self.address = f"socketcand:{port}"
        muscle = Muscle(self.address, self._node, deadline_s=self._deadline_s)
        try:
            await muscle.connect()
        except BaseException:
            await self._end()
            raise
        self._muscle = muscle
        return self

    async def stop(self) -> None:
        """The results are then in the folder."""
        if self._muscle is not None:
            muscle, self._muscle = self._muscle, None
            try:
                await muscle.close()
            finally:
                await self._end()

    async def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.send_signal(signal.SIGINT)
            try:
                await asyncio.to_thread(process.communicate, None, _ENDS_WITHIN_S)
            except subprocess.TimeoutExpired:
                process.kill()
                await asyncio.to_thread(process.communicate)
            self._kill.detach()
        if self._temporary is not None:
            self._temporary.cleanup()

    async def __aenter__(self) -> Self:
        return await self.start()

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None,
                        trace: TracebackType | None) -> None:
        await self.stop()

    def __enter__(self) -> "sync.Simulation":
        """with Simulation("bench") as simulation: ... gives the same without asyncio."""
        from supercoil import sync
        self._synchronous = sync.Simulation.of(self)
        return self._synchronous.__enter__()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self._synchronous.__exit__(kind, error, trace)
