"""What a board learns about its muscle, and how it is compared with meters."""

import contextlib
import time
from typing import NamedTuple

from supercoil.codec import FORGET, RISES_FROM, STORE
from supercoil.commands import Commands
from supercoil.connection import FRESH_BEATS, HEARTBEAT_S
from supercoil.errors import NoAnswerError, NotReachedError, OutcomeError
from supercoil.generated import messages, results
from supercoil.generated.names import Mode, Opcode, Result, State
from supercoil.named import duration, number

_FRICTION = 1 << results.NOTES.index("friction")  # its bit is in another message than the others


class Outcome(NamedTuple):
    """How identify or calibrate ended, and what else identify reports."""

    result: Result
    notes: tuple[str, ...]


class Learning(Commands):
    async def identify(self, timeout_s: float = 3600.0) -> Outcome:
        """Identifies the muscle. Raises OutcomeError unless something was found."""
        return await self._learn(Opcode.identify, Mode.identify, timeout_s)

    async def calibrate(self, timeout_s: float = 600.0) -> Outcome:
        """Measures the cold zero and the cold resistance. Likewise."""
        return await self._learn(Opcode.calibrate, Mode.calibrate, timeout_s)

    async def _learn(self, opcode: Opcode, mode: Mode, timeout_s: float) -> Outcome:
        heartbeat = self._link.heartbeat
        end = time.monotonic() + duration("timeout_s", timeout_s)
        await self._heat(opcode)
        fresh_at = heartbeat.beats + FRESH_BEATS
        while heartbeat.beats < fresh_at or heartbeat.status is None or (
                heartbeat.status.result == Result.running or (heartbeat.status.mode == mode
                and heartbeat.state == State.active)):
            self._kept.alive()
            await heartbeat.change(HEARTBEAT_S)
            await heartbeat.raise_fault()
            if time.monotonic() > end:
                await self.rest()
                raise NotReachedError(f"node {self.node}: {opcode.name} has not ended within {timeout_s:g} s")
        self._kept.rests()
        return await self._outcome(opcode)

    async def _outcome(self, opcode: Opcode) -> Outcome:
        status = self._link.heartbeat.status
        assert status is not None
        bits = _FRICTION if status.friction else 0
        if opcode == Opcode.identify:
            with contextlib.suppress(NoAnswerError):
                async for estimate in self.stream(messages.Estimate):
                    bits |= estimate.identify_notes
                    break
        notes = tuple(note for bit, note in enumerate(results.NOTES) if bits >> bit & 1)
        if status.result not in (Result.found, Result.not_stored):
            meaning = results.MEANINGS.get(status.result, "")
            others = ", ".join(note for note in notes if note != str(status.result))
            raise OutcomeError(f"node {self.node}: {opcode.name} ended: {status.result}: {meaning}"
                               + (f"; {others}" if others else ""), str(status.result), notes)
        return Outcome(status.result, notes)

    async def scale(self, true_position_m: float) -> None:
        """Gives the board the present true position, by a ruler."""
        await self._obey(Opcode.scale, true_position_m)

    async def store(self) -> None:
        """Keeps the trusted estimates for the next start."""
        await self._obey(Opcode.store, STORE)

    async def forget(self) -> None:
        """Forgets the stored muscle from the next start on."""
        await self._obey(Opcode.store, FORGET)

    async def use_controller(self, place: int) -> None:
        """Selects a controller by its place in the configuration, from 0."""
        await self._obey(Opcode.controller, place)

    async def use_estimator(self, place: int) -> None:
        await self._obey(Opcode.estimator, place)

    async def compare_supply(self, volts: float) -> None:
        """What a meter shows at the supply's terminals during steady power; 0 forgets the comparison."""
        if not 0.0 <= number("volts", volts) < RISES_FROM:
            raise ValueError(f"{volts} V: must be 0 or more")
        await self._obey(Opcode.compare, volts)

    async def compare_current(self, amperes: float) -> None:
        """What a meter shows in the channel's line."""
        if not number("amperes", amperes) > 0.0:
            raise ValueError(f"{amperes} A: must be above 0")
        await self._obey(Opcode.compare, -amperes)

    async def compare_rise(self, kelvins: float) -> None:
        """How much warmer than the air a thermometer shows the muscle in steady heat; 0 forgets it."""
        if not number("kelvins", kelvins) >= 0.0:
            raise ValueError(f"{kelvins} K: must be 0 or more")
        await self._obey(Opcode.compare, RISES_FROM + kelvins)
