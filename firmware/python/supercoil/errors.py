"""What may go wrong. generated.faults has an exception for each fault, generated.refusals one for each refusal."""

import math
from typing import ClassVar

from supercoil.generated.version import PROTOCOL_VERSION, __version__


def _restored(kind: type[Exception], args: tuple[object, ...]) -> Exception:
    return kind.__new__(kind, *args)


class SupercoilError(Exception):
    """Base of all exceptions of this package."""

    def __reduce__(self) -> tuple[object, ...]:
        """Pickled as it is, for processes that pass it on: its constructor takes other arguments than the text."""
        return _restored, (type(self), self.args), self.__dict__


class FaultError(SupercoilError):
    """A fault is latched: the muscle goes cold. page has the full text of its page."""

    number: ClassVar[int] = 0
    name: ClassVar[str] = ""
    meaning: ClassVar[str] = ""
    remedy: ClassVar[str] = ""
    page: ClassVar[str] = ""

    def __init__(self, node: int, measured: float = math.nan, limit: float = math.nan) -> None:
        self.node = node
        self.measured = measured  # by the detector, in its own unit; NaN: not known
        self.limit = limit
        margin = "" if math.isnan(limit) else f" (measured {measured:.4g}, limit {limit:.4g})"
        super().__init__(f"node {node}: {self.name}{margin}: {self.meaning}\nRemedy:\n{self.remedy}")


class UnknownFaultError(FaultError):
    """A fault that this version of the package has no page for."""

    name = "unknown"
    meaning = "the board knows faults that this package does not: install the package of the board's release"


class RefusalError(SupercoilError):
    """The board refused a command. nearest: the nearest value that it would have obeyed; NaN: none, or not known.
    reason: the board's own explanation, only over its own socket. time_s: of the refused knot of play(), as it was
    given; NaN: another command."""

    number: ClassVar[int] = 0
    name: ClassVar[str] = ""
    meaning: ClassVar[str] = ""

    def __init__(self, node: int, command: str, nearest: float = math.nan, reason: str = "",
                 time_s: float = math.nan) -> None:
        self.node = node
        self.command = command
        self.nearest = nearest
        self.reason = reason
        self.time_s = time_s
        instead = "" if math.isnan(nearest) else f"; {nearest:.7g} would be obeyed"
        because = f": {reason}" if reason else ""
        super().__init__(f"node {node}: {command} is refused: {self.name}{instead}{because} ({self.meaning})")


class BusError(SupercoilError):
    """The bus cannot be opened, or a frame cannot be sent."""


class NoAnswerError(SupercoilError, TimeoutError):
    """Nothing came from the board in time."""


class VersionMismatchError(SupercoilError):
    """The board speaks another version of the CAN protocol. stop() still stops it."""

    def __init__(self, node: int, of_board: int) -> None:
        self.node = node
        self.of_board = of_board
        self.of_package = PROTOCOL_VERSION
        older = "the board's firmware" if of_board < PROTOCOL_VERSION else "this package"
        super().__init__(
            f"node {node} speaks version {of_board} of the CAN protocol, supercoil {__version__} for Python speaks "
            f"{PROTOCOL_VERSION}: {older} is the older one. Install the package that came with the board's firmware "
            "(firmware/python of its release), or reinstall the board's firmware. supercoil.stop() still stops it")


class NotReachedError(SupercoilError, TimeoutError):
    """The muscle did not reach its set point in time."""


class OutcomeError(SupercoilError):
    """identify or calibrate ended and found nothing; result and notes say why."""

    def __init__(self, text: str, result: str, notes: tuple[str, ...]) -> None:
        self.result = result
        self.notes = notes
        super().__init__(text)


class DeadlineError(SupercoilError):
    """The program was silent for longer than its deadline, so its muscle was let go."""


class PlaybackError(SupercoilError):
    """The board no longer plays the trajectory: another command came meanwhile, or it has not started."""


class DryError(PlaybackError):
    """A knot came too late: the board holds the previous one for 1 s and then lets the muscle rest."""


class SimulationError(SupercoilError):
    """supercoil-sim is missing, or has ended."""
