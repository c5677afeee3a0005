"""A muscle on a board: asynchronous. sync.Muscle is the same for programs without asyncio."""

from types import TracebackType
from typing import TYPE_CHECKING

from supercoil.playing import Playing

if TYPE_CHECKING:
    from supercoil import sync


class Muscle(Playing):
    """async with Muscle("can0", node=1) as muscle: ... It is disarmed at the end of the block."""

    def __enter__(self) -> "sync.Muscle":
        """with Muscle("can0", node=1) as muscle: ... gives the same without asyncio."""
        from supercoil import sync
        self._synchronous = sync.Muscle.of(self)
        return self._synchronous.__enter__()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self._synchronous.__exit__(kind, error, trace)
