"""The board's own socket, without CAN: for programs on the board itself. Lines of text, each answered by one packet."""

import asyncio
import contextlib
import math
import socket
import time

from supercoil import codec
from supercoil.clock import SocketClock
from supercoil.errors import BusError, NoAnswerError, PlaybackError, RefusalError, SupercoilError
from supercoil.generated import messages, names, refusals
from supercoil.generated.names import Opcode, Quantity, Refusal, Setting, Tunable, When
from supercoil.heartbeat import Heartbeat
from supercoil.local_text import command_line, frames_of, trajectory_of
from supercoil.telemetry import Telemetry

_ANSWER_WITHIN_S = 2.0
_POLL_PERIOD_S = 0.1
_MAX_BYTES = 8192
_SENSES = (Setting.supply_gain, Setting.current_gain, Setting.sense_error_ratio)


def _unmarked(answer: str) -> str:
    """As a person is told it: supercoild marks what is wrong with a line."""
    return answer.removeprefix("wrong: ")


class SocketLink:
    """The socket has no lease: whoever can open it can command. The state is requested ten times a second."""

    lease_age_s = 0.0

    def __init__(self, path: str, channel: int) -> None:
        self.telemetry = Telemetry(channel)
        self.heartbeat = Heartbeat(channel)
        self.trajectory = trajectory_of(["empty", "0", "0"])
        self.clock = SocketClock.of(path)
        self.holds_lease = False  # something was commanded
        self._path = path
        self._channel = channel
        self._socket: socket.socket | None = None
        self._ended = f"{path} is not connected"
        self._exchange_lock = asyncio.Lock()
        self._exchanges: set[asyncio.Future[str]] = set()
        self._polling: asyncio.Task[None] | None = None

    async def open(self) -> None:
        opened = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        opened.setblocking(False)
        try:
            await asyncio.get_running_loop().sock_connect(opened, self._path)
        except OSError as error:
            opened.close()
            hint = "; is supercoild running?" if isinstance(error, FileNotFoundError | ConnectionRefusedError) else ""
            if isinstance(error, PermissionError):
                hint = "; who commands a board must be in its group supercoil"
            raise BusError(f"{self._path}: {error.strerror}{hint}") from error
        self._socket = opened
        try:
            await self._read_state()
        except BaseException:
            await self.close()
            raise
        self._polling = asyncio.create_task(self._poll())

    async def close(self) -> None:
        if self._polling is not None:
            self._polling.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._polling
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    async def command(self, opcode: Opcode, value: float) -> None:
        await self._obey(command_line(opcode, value))
        self.holds_lease = True

    async def _obey(self, line: str) -> None:
        answer = await self._ask(f"{self._channel} {line}")
        if answer != "ok":
            raise self._refused(line, answer)

    async def disarm(self) -> None:
        await self.command(Opcode.disarm, 0.0)

    async def write(self, setting: Setting, value: float) -> float:
        raise SupercoilError(f"{setting} cannot be changed through the board's socket, only over CAN")

    async def read(self, setting: Setting) -> float:
        """Only the settings of the senses; the others are available over CAN only."""
        if setting not in _SENSES:
            return math.nan
        return (await self._numbers("senses"))[_SENSES.index(setting)]

    async def quantity(self, quantity: Quantity) -> float:
        """NaN also if the board is older than the quantity."""
        values = await self._numbers("muscle")
        return values[quantity] if quantity < len(values) else math.nan

    async def prepare(self, place: int, tunable: Tunable, value: float) -> None:
        text = names.Set(int(value)).name if tunable == Tunable.all else repr(value)
        line = f"prepare {self._channel} {place} {tunable} {text}"
        answer = await self._ask(line)
        if answer != "ok":
            raise self._refused(f"{tunable} = {text}", answer)

    async def tuned(self, place: int, tunable: Tunable, of: names.Set) -> float:
        line = f"tuning {self._channel} {place} {tunable} {of}"
        answer = await self._ask(line)
        try:
            return float(answer)
        except ValueError:
            raise self._refused(line, answer) from None

    async def knot(self, after_s: float, position_m: float, velocity_m_per_s: float) -> messages.Trajectory:
        await self._obey(f"knot {after_s!r} {position_m!r} {velocity_m_per_s!r}")
        await self._read_playback()
        return self.trajectory

    async def play(self, when: When, sync: int = 0, after_s: float = 0.0) -> messages.Trajectory:
        board_s = await self._read_playback()
        if when != When.never:
            at_s = self.clock.start_s(sync, board_s, after_s) if when == When.at_sync else board_s + after_s
            try:
                await self._obey(f"start {at_s!r}")
            except refusals.OutOfRange:  # only the start time can be out of range
                raise PlaybackError(f"node {self._channel}: has not started: the start was sent too late: this "
                                    "machine was busy") from None
            await self._read_playback()
        return self.trajectory

    async def _read_playback(self) -> float:
        """Returns the board's time."""
        *words, board_s = await self._words("playback")
        self.trajectory = trajectory_of(words)
        return float(board_s)

    async def keep(self) -> None:
        pass

    async def release(self) -> None:
        self.holds_lease = False

    async def _ask(self, line: str) -> str:
        """Completes even if the asking task is cancelled: a late answer would be taken for the next one's."""
        exchange = asyncio.ensure_future(self._exchange(line))
        self._exchanges.add(exchange)
        exchange.add_done_callback(self._exchanges.discard)
        return await asyncio.shield(exchange)

    async def _exchange(self, line: str) -> str:
        loop = asyncio.get_running_loop()
        async with self._exchange_lock:
            if self._socket is None:
                raise BusError(self._ended)
            try:
                async with asyncio.timeout(_ANSWER_WITHIN_S):
                    await loop.sock_sendall(self._socket, line.encode())
                    answer = (await loop.sock_recv(self._socket, _MAX_BYTES)).decode()
            except TimeoutError:
                silent = f"supercoild does not answer within {_ANSWER_WITHIN_S:g} s"
                self._end(silent)  # as above
                raise NoAnswerError(silent) from None
            except OSError as error:
                ended = isinstance(error, BrokenPipeError | ConnectionResetError)
                self._end("supercoild has ended" if ended else str(error.strerror))
                raise BusError(self._ended) from error
            if not answer:
                self._end("supercoild has ended")
                raise BusError(self._ended)
            return answer.strip()

    def _end(self, why: str) -> None:
        self._ended = f"{self._path}: {why}"
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    async def _words(self, request: str) -> list[str]:
        """The words after the channel's number in its line."""
        answer = await self._ask(request)
        for line in answer.splitlines():
            channel, *words = line.split()
            if channel == str(self._channel):
                return words
        raise BusError(f"{self._path}: nothing is known about channel {self._channel}: {_unmarked(answer)}")

    async def _numbers(self, request: str) -> list[float]:
        return [float(word) for word in await self._words(request)]

    def _refused(self, line: str, answer: str) -> SupercoilError:
        verdict, _, rest = answer.partition(": ")
        if verdict != "refused":
            return SupercoilError(f"channel {self._channel}: {line}: {_unmarked(answer)}")
        name, _, reason = rest.partition(": ")
        name, _, instead = name.partition("; ")
        refusal = Refusal.__members__.get(name, Refusal.queue_full)
        nearest = float(instead.split()[0]) if instead else math.nan
        return refusals.BY_NUMBER.get(refusal, RefusalError)(self._channel, line, nearest, reason)

    async def _read_state(self) -> None:
        state, status = await self._words("state"), await self._words("status")
        now = time.time()
        for base, values in frames_of(state, probing=status[-1] == "probing"):
            data = codec.encode(codec.LAYOUTS[base], values)
            self.telemetry.take(base, now, data)
            if base == messages.STATUS:
                self.heartbeat.receive_frame(base, now, data)

    async def _poll(self) -> None:
        with contextlib.suppress(BusError, NoAnswerError):  # the next command reports it
            while True:
                await asyncio.sleep(_POLL_PERIOD_S)
                await self._read_state()
