"""Records what a node sends from now on: as messages, as arrays, as a pandas table."""

from collections import deque
from collections.abc import Iterator
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self, TypeVar

from supercoil import codec
from supercoil.telemetry import Telemetry, base_of

if TYPE_CHECKING:
    import numpy
    import pandas

M = TypeVar("M", bound=tuple[Any, ...])


class Recording:
    """Used as 'with muscle.record() as recording'; it keeps its messages afterwards."""

    def __init__(self, telemetry: Telemetry, bases: tuple[int, ...], most_frames: int | None = None) -> None:
        self._telemetry = telemetry
        self._bases = frozenset(bases or codec.LAYOUTS)
        # time, base, data; the oldest are dropped when there are most_frames
        self.frames: deque[tuple[float, int, bytes]] = deque(maxlen=most_frames)

    def start(self) -> Self:
        self._telemetry.listen(self._keep)
        return self

    def stop(self) -> None:
        self._telemetry.forget(self._keep)

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.stop()

    def _keep(self, base: int, time_s: float, data: bytes) -> None:
        if base in self._bases:
            self.frames.append((time_s, base, data))

    def of(self, kind: type[M]) -> Iterator[M]:
        """Every message of a kind."""
        wanted = base_of(kind)
        for time_s, base, data in list(self.frames):
            if base == wanted and (message := codec.decode(base, data, time_s)) is not None:
                yield message

    def arrays(self, kind: type[Any] | str) -> dict[str, "numpy.ndarray[Any, Any]"]:
        """An array for each signal, and time_s; needs numpy."""
        from supercoil.arrays import decode_all
        wanted = base_of(kind)
        return decode_all(wanted, [(time_s, data) for time_s, base, data in list(self.frames) if base == wanted])

    def table(self, *kinds: type[Any] | str) -> "pandas.DataFrame":
        """A row for each time since the first frame, and a column Message.signal for each signal. Needs pandas."""
        from supercoil.tables import table_of
        bases = frozenset(base_of(kind) for kind in kinds) or self._bases
        frames = list(self.frames)
        return table_of([(time_s - frames[0][0], base, data) for time_s, base, data in frames if base in bases])
