"""The frames of a trajectory, and the node's reports about it (docs/trajectories.md)."""

from collections.abc import Awaitable, Callable

from supercoil import codec, e2e
from supercoil.generated import messages
from supercoil.generated.names import Answers, Refusal, When
from supercoil.session import Answer, Send, Session

_KNOT = codec.LAYOUTS[messages.KNOT]
_PLAY = codec.LAYOUTS[messages.PLAY]


class PlaybackSession(Session):
    """A session that sends trajectories too. A knot never claims a lease: under a new lease the board has forgotten the
    earlier knots."""

    def __init__(self, node: int, send: Send) -> None:
        super().__init__(node, send)
        self.trajectory: messages.Trajectory = codec.decode(messages.TRAJECTORY, bytes(8))  # empty

    async def knot(self, after_s: float, position_m: float, velocity_m_per_s: float) -> None:
        """Returns when the board has taken the knot; trajectory has the room that is left. after_s 0: the first one."""
        async def send() -> Answer:
            number = self._number
            async with self._in_flight:
                return await self._exchange(
                    _KNOT, (Answers.knot, number & 0xFF), checked_session=number, after_s=after_s,
                    position_m=position_m, velocity_m_per_s=velocity_m_per_s)
        await self._retry_once("knot", send)

    async def play(self, when: When, sync: int = 0, after_s: float = 0.0) -> None:
        """Starts the trajectory; When.never only asks for trajectory."""
        async def send() -> Answer:
            number = self._number
            async with self._in_flight:
                return await self._exchange(_PLAY, (Answers.play, number & 0xFF), when=when, session=number, sync=sync,
                                            after_s=after_s)
        await self._retry_once("play", send)

    def receive(self, base: int, data: bytes) -> None:
        """Handles a Trajectory of the node too."""
        if base != messages.TRAJECTORY:
            super().receive(base, data)
        elif e2e.is_intact(base | self.node, data) and (state := codec.decode(base, data)) is not None:
            self.trajectory = state
            self._settle((base, state.counter, state.answers, state.session_low), Answer(state.refusal, state.room))

    async def _retry_once(self, command: str, send: Callable[[], Awaitable[Answer]]) -> None:
        if not self.holds_lease:
            raise self._refused(Refusal.no_lease, command)
        answer = await send()
        if answer.refusal == Refusal.wrong_counter:  # earlier frames were lost, and this one was not taken
            answer = await send()
        await self._judge(command, answer)
