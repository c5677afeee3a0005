"""The frames of a master that commands one node under a lease, and the node's answers (docs/can.md)."""

import asyncio
import math
import secrets
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

from supercoil import codec, e2e
from supercoil.errors import NoAnswerError, RefusalError
from supercoil.generated import messages, refusals
from supercoil.generated.names import Opcode, Refusal, Set, Setting, Tunable
from supercoil.layout import Layout

ANSWER_WITHIN_S = 0.5
# A lease lasts a second by default; one that may have run out is claimed again first.
LEASE_LASTS_S = 0.4
# RefusedValue follows the answer at once, if the board sends it.
_NEAREST_WITHIN_S = 0.05
_MAX_CLAIMS = 4
# Of 16 counters, so that those of a frame without an answer are not used again at once.
_MAX_IN_FLIGHT = 8
_RELEASES = -1.0
# A second try can help here: the lease ran out meanwhile, or earlier frames were lost.
_TRY_AGAIN = (Refusal.no_lease, Refusal.wrong_counter)

_COMMAND = codec.LAYOUTS[messages.COMMAND]
_SETTING_WRITE = codec.LAYOUTS[messages.SETTING_WRITE]
_TUNING_WRITE = codec.LAYOUTS[messages.TUNING_WRITE]
_ANSWERS = {messages.COMMAND: messages.ACKNOWLEDGE, messages.SETTING_WRITE: messages.SETTING,
            messages.TUNING_WRITE: messages.TUNING, messages.KNOT: messages.TRAJECTORY,
            messages.PLAY: messages.TRAJECTORY}

Send = Callable[[int, bytes], Awaitable[None]]


@dataclass
class Answer:
    refusal: Refusal
    value: float  # the granted session or number; for a setting, its value now; for a trajectory, its room
    nearest: "asyncio.Future[float] | None" = None


class Session:
    """Commands may overlap; they are sent in the order in which they were issued."""

    def __init__(self, node: int, send: Send) -> None:
        self.node = node
        self._send = send
        self._name = secrets.randbelow(0xFFFF) + 1  # identifies the answer to a claim
        self._number = 0  # the session; 0: no lease
        self._counter = 0
        self._lease_from = -math.inf
        self._claiming = asyncio.Lock()
        self._sending = asyncio.Lock()
        self._in_flight = asyncio.Semaphore(_MAX_IN_FLIGHT)
        # Keyed by what an answer says it answers: message, counter, and so on.
        self._pending: dict[tuple[int, ...], asyncio.Future[Answer]] = {}
        self._newest_refused: asyncio.Future[float] | None = None

    @property
    def holds_lease(self) -> bool:
        return self._number != 0

    @property
    def lease_age_s(self) -> float:
        """Time since the last command that was obeyed."""
        return time.monotonic() - self._lease_from

    async def command(self, opcode: Opcode, value: float = 0.0) -> None:
        """Returns when the command was obeyed. Claims the lease if there is none."""
        await self._retry_under_lease(opcode.name, lambda: self._ask(opcode, value))

    async def write(self, setting: Setting, value: float) -> float:
        """Writes a setting; returns the value that holds from then on."""
        return await self._retry_under_lease(f"{setting.name} = {value:.7g}", lambda: self._write(setting, value))

    async def prepare(self, place: int, tunable: Tunable, value: float) -> None:
        """Prepares a value of a controller, or with all every value of one of the sets."""
        text = Set(int(value)).name if tunable == Tunable.all else f"{value:.7g}"
        await self._retry_under_lease(f"{tunable.name} = {text}", lambda: self._prepare(place, tunable, value))

    async def disarm(self) -> None:
        """Obeyed from every master, in every version of the protocol."""
        await self._judge("disarm", await self._ask(Opcode.disarm, 0.0))

    async def keep(self) -> None:
        """Keeps the lease if there is nothing to command; notes a lease that has ended."""
        answer = await self._ask(Opcode.lease, 0.0)
        if answer.refusal == Refusal.none:
            self._lease_from = time.monotonic()
        else:
            self._number = 0

    async def release(self) -> None:
        if self.holds_lease:
            await self._ask(Opcode.lease, _RELEASES)
            self._number = 0

    def receive(self, base: int, data: bytes) -> None:
        """Handles an Acknowledge, Setting, Tuning or RefusedValue of the node."""
        message = codec.decode(base, data)
        if base == messages.REFUSED_VALUE and message is not None:
            if self._newest_refused is not None and not self._newest_refused.done():
                self._newest_refused.set_result(message.nearest)
        elif message is not None and e2e.is_intact(base | self.node, data):
            self._receive_answer(base, message)

    def _receive_answer(self, base: int, message: messages.Acknowledge | messages.Setting | messages.Tuning) -> None:
        echo: tuple[int, int]
        if isinstance(message, messages.Acknowledge):
            echo, value = (message.opcode, message.session), float(message.granted)
        elif isinstance(message, messages.Setting):
            echo, value = (message.setting, message.session_low), message.value
        else:
            echo, value = (message.place, message.tunable), message.value
        answer = Answer(message.refusal, value)
        if self._settle((base, message.counter, *echo), answer) and answer.refusal == Refusal.out_of_range:
            answer.nearest = self._newest_refused = asyncio.get_running_loop().create_future()

    def _settle(self, key: tuple[int, ...], answer: Answer) -> bool:
        """Whether a call waits for the answer. That call goes on later, in the event loop."""
        answered = self._pending.get(key)
        if answered is None or answered.done():
            return False
        answered.set_result(answer)
        return True

    def _next_counter(self) -> int:
        self._counter = (self._counter + 1) % e2e.COUNTERS
        return self._counter

    async def _ask(self, opcode: Opcode, value: float) -> Answer:
        async with self._in_flight:
            carried = self._number or self._name
            return await self._exchange(_COMMAND, (opcode, carried), opcode=opcode, session=carried, value=value)

    async def _write(self, setting: Setting, value: float) -> Answer:
        async with self._in_flight:
            return await self._exchange(_SETTING_WRITE, (setting, self._number & 0xFF), setting=setting,
                                        session=self._number, value=value)

    async def _prepare(self, place: int, tunable: Tunable, value: float) -> Answer:
        async with self._in_flight:
            return await self._exchange(_TUNING_WRITE, (place, tunable), place=place, tunable=tunable,
                                        session_low=self._number & 0xFF, value=value)

    async def _exchange(self, layout: Layout, echo: tuple[int, ...], *, checked_session: int | None = None,
                        **fields: float) -> Answer:
        """checked_session: for a frame that has the session in its checksum only."""
        identifier = layout.base | self.node
        answered: asyncio.Future[Answer] = asyncio.get_running_loop().create_future()
        key: tuple[int, ...] = ()
        try:
            async with self._sending:  # in the order of the counters, even if the bus is busy
                counter = self._next_counter()
                if counter == 0 and layout in (_SETTING_WRITE, _TUNING_WRITE):
                    counter = self._next_counter()  # 0 is the counter of an answer to a read
                key = (_ANSWERS[layout.base], counter, *echo)
                self._pending[key] = answered
                await self._send(identifier, e2e.protected(
                    identifier, codec.encode(layout, {**fields, "counter": counter}), checked_session))
            async with asyncio.timeout(ANSWER_WITHIN_S):
                return await answered
        except TimeoutError as error:
            raise NoAnswerError(f"node {self.node} does not answer within {ANSWER_WITHIN_S} s") from error
        finally:
            if self._pending.get(key) is answered:
                del self._pending[key]

    async def _retry_under_lease(self, command: str, attempt: Callable[[], Awaitable[Answer]]) -> float:
        await self._hold_lease()
        number = self._number
        answer = await attempt()
        if answer.refusal in _TRY_AGAIN:
            if answer.refusal == Refusal.no_lease:
                await self._claim(number)
            answer = await attempt()
        return await self._judge(command, answer)

    async def _judge(self, command: str, answer: Answer) -> float:
        if answer.refusal == Refusal.none:
            self._lease_from = time.monotonic()
            return answer.value
        if answer.refusal in (Refusal.no_lease, Refusal.not_lease_holder):
            self._number = 0
        nearest = math.nan
        if answer.nearest is not None:
            try:
                async with asyncio.timeout(_NEAREST_WITHIN_S):
                    nearest = await answer.nearest
            except TimeoutError:
                pass
        raise self._refused(answer.refusal, command, nearest)

    def _refused(self, refusal: Refusal, command: str, nearest: float = math.nan) -> RefusalError:
        return refusals.BY_NUMBER.get(refusal, RefusalError)(self.node, command, nearest)

    async def _hold_lease(self) -> None:
        if not self.holds_lease:
            await self._claim(0)
        elif self.lease_age_s > LEASE_LASTS_S:
            await self.keep()
            if not self.holds_lease:
                await self._claim(0)

    async def _claim(self, lost: int) -> None:
        """Does nothing if another command has claimed meanwhile: the session then differs from the lost one."""
        async with self._claiming:
            if self._number != lost:
                return
            self._number = 0
            answer = await self._ask(Opcode.lease, 0.0)
            for _ in range(_MAX_CLAIMS):  # another master may use a nonce first
                if answer.refusal != Refusal.claim_again:
                    break
                answer = await self._ask(Opcode.lease, answer.value)
            if answer.refusal == Refusal.no_lease:
                # A board of an older version took the claim for a command without a lease.
                raise self._refused(Refusal.protocol_mismatch, "lease")
            if answer.refusal != Refusal.none:
                raise self._refused(answer.refusal, "lease")
            self._number = int(answer.value)
            self._lease_from = time.monotonic()
