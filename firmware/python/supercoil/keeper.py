"""Renews commands to heat and keeps the lease for as long as the program itself is heard from now and then.

A command to heat expires on the board 250 ms after its last renewal, whatever happens to this process. If the process
runs but the program in it hangs, the deadline here ends the renewals. If the program ends without close(), so does the
connection here: with asyncio.run, and with Python itself where the event loop runs in a thread, as that of sync does.
"""

import asyncio
import atexit
import concurrent.futures
import contextlib
import logging
import time
from typing import ClassVar

from supercoil.errors import DeadlineError, NoAnswerError, RefusalError, SupercoilError
from supercoil.generated.names import Opcode
from supercoil.link import Link
from supercoil.session import LEASE_LASTS_S

RENEW_EVERY_S = 0.06  # three renewals fit into 250 ms
_KEEP_PERIOD_S = 0.3
_NAP_S = 0.02
_MAX_UNANSWERED = 4  # renewals in a row, 2 s
_END_WITHIN_S = 2.0

_log = logging.getLogger("supercoil")


class Keeper:
    _connected: ClassVar[set["Keeper"]] = set()

    def __init__(self, link: Link, node: int, deadline_s: float) -> None:
        self._link = link
        self._node = node
        self._deadline_s = deadline_s
        self._alive_at = time.monotonic()
        self._renewed_at = 0.0
        self._heats = False
        self._commanded = False
        self._let_go = False
        self._unanswered = 0
        self._lost: SupercoilError | None = None
        self._loop = asyncio.get_running_loop()
        self._task: asyncio.Task[None] | None = None

    def start(self) -> None:
        self._task = asyncio.create_task(self._run())
        self._connected.add(self)
        # Last in, first out: before the exit handler that kills a simulation, whose muscle this may be.
        atexit.unregister(Keeper.end_all)
        atexit.register(Keeper.end_all)

    async def end(self) -> None:
        """Renews nothing any more, disarms the muscle if it was commanded, and releases the lease."""
        self._connected.discard(self)
        task, self._task = self._task, None
        if task is not None:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task
        await self._disarm()

    async def _disarm(self) -> None:
        # The lease may have been released at the deadline, or have run out while the event loop was blocked; another
        # master that now has it is not stopped.
        if self._link.holds_lease and self._link.lease_age_s > LEASE_LASTS_S:
            with contextlib.suppress(NoAnswerError):
                await self._link.keep()
        leased = self._link.heartbeat.status is not None and self._link.heartbeat.status.leased
        if self._link.holds_lease or (self._commanded and not leased):
            await self._link.disarm()
            await self._link.release()

    @classmethod
    def end_all(cls) -> None:
        """At Python's exit, when nothing can be awaited any more. A loop that does not run cannot send."""
        ends = [asyncio.run_coroutine_threadsafe(keeper.end(), keeper._loop) for keeper in list(cls._connected)
                if keeper._loop.is_running()]
        concurrent.futures.wait(ends, timeout=_END_WITHIN_S)

    def alive(self) -> None:
        """The program shows that it is alive."""
        self._alive_at = time.monotonic()

    def commanded(self) -> None:
        """A command was obeyed."""
        self._commanded = True

    def heats(self) -> None:
        """A command to heat was obeyed."""
        self._heats = True
        self._lost = None
        self._unanswered = 0
        self._renewed_at = time.monotonic()

    def rests(self) -> None:
        self._heats = False
        self._lost = None

    @property
    def lost(self) -> SupercoilError | None:
        """Why the board no longer obeys the last command to heat; None: it does, or there is none."""
        return self._lost

    def raise_if_let_go(self) -> None:
        """Raises once: the program may continue after that."""
        if self._let_go:
            self._let_go = False
            raise DeadlineError(
                f"node {self._node}: the program said nothing for {self._deadline_s:g} s, so the muscle was let go. "
                "Wait with hold(), or give Muscle a longer deadline_s")

    async def _run(self) -> None:
        try:
            await self._keep()
        except asyncio.CancelledError:
            if self._task is not None:  # by the end of asyncio.run
                self._connected.discard(self)
                with contextlib.suppress(SupercoilError):
                    await self._disarm()
            raise

    async def _keep(self) -> None:
        while True:
            await asyncio.sleep(_NAP_S)
            try:
                await self._update()
            except RefusalError as refused:  # a fault, another master, or the mode has ended
                if self._heats:
                    self._lose(refused)
                    self._heats = False
            except NoAnswerError as silent:  # the command expires on the board; the next round tries again
                self._unanswered += 1
                if self._heats and self._unanswered >= _MAX_UNANSWERED:
                    self._lose(silent)
            except SupercoilError as error:
                _log.error("node %d: %s", self._node, error)
                if self._heats:
                    self._lose(error)
                return

    def _lose(self, why: SupercoilError) -> None:
        self._lost = why.with_traceback(None)  # of this task: whoever catches the error may clear its frames

    async def _update(self) -> None:
        if not self._link.holds_lease:
            self._heats = False
            return
        now = time.monotonic()
        if now - self._alive_at > self._deadline_s:
            await self._give_up()
        elif self._heats and now - self._renewed_at >= RENEW_EVERY_S:
            self._renewed_at = now
            await self._link.command(Opcode.renew, 0.0)
            self._unanswered = 0
            self._lost = None
        elif self._link.lease_age_s >= _KEEP_PERIOD_S:
            await self._link.keep()

    async def _give_up(self) -> None:
        if self._heats:
            self._heats = False
            self._let_go = True
            _log.warning("node %d: the program said nothing for %g s: the muscle is let go", self._node,
                         self._deadline_s)
            await self._link.command(Opcode.rest, 0.0)
        await self._link.release()
