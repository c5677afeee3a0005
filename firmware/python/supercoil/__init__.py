"""Scripts for supercoil boards, which drive super-coiled polymer artificial muscles.

    async with supercoil.Muscle("can0", node=1) as muscle:
        await muscle.arm()
        await muscle.move_to(0.010)

and the same without asyncio: with supercoil.Muscle("can0", node=1) as muscle: ...
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from supercoil import sync
from supercoil.commands import Order
from supercoil.cycles import cycle
from supercoil.discovery import Found, discover, stop
from supercoil.errors import (
    BusError,
    DeadlineError,
    DryError,
    FaultError,
    NoAnswerError,
    NotReachedError,
    OutcomeError,
    PlaybackError,
    RefusalError,
    SimulationError,
    SupercoilError,
    VersionMismatchError,
)
from supercoil.generated import faults, messages, refusals
from supercoil.generated.names import (
    Fault,
    Gain,
    LimitedBy,
    Mode,
    Opcode,
    Parameter,
    Quantity,
    Refusal,
    Result,
    Setting,
    State,
)
from supercoil.generated.version import PROTOCOL_VERSION, __version__
from supercoil.joints import Joint, LeverTable
from supercoil.learning import Outcome
from supercoil.muscle import Muscle
from supercoil.player import Motion
from supercoil.playing import play
from supercoil.recording import Recording
from supercoil.simulation import Simulation
from supercoil.telemetry import Telemetry
from supercoil.tuning import Tuned

if TYPE_CHECKING:
    import pandas

__all__ = [
    "PROTOCOL_VERSION",
    "BusError",
    "DeadlineError",
    "DryError",
    "Fault",
    "FaultError",
    "Found",
    "Gain",
    "Joint",
    "LeverTable",
    "LimitedBy",
    "Mode",
    "Motion",
    "Muscle",
    "NoAnswerError",
    "NotReachedError",
    "Opcode",
    "Order",
    "Outcome",
    "OutcomeError",
    "Parameter",
    "PlaybackError",
    "Quantity",
    "Recording",
    "Refusal",
    "RefusalError",
    "Result",
    "Setting",
    "Simulation",
    "SimulationError",
    "State",
    "SupercoilError",
    "Telemetry",
    "Tuned",
    "VersionMismatchError",
    "__version__",
    "cycle",
    "discover",
    "faults",
    "load",
    "messages",
    "play",
    "plot",
    "refusals",
    "stop",
    "sync",
]


def load(path: str | Path, *, node: int | None = None) -> "pandas.DataFrame":
    """Loads can.log, a flight recording or a trace (CSV or npy) as a pandas table; attrs["units"]: units of columns.

    node: which node of a can.log, if it has several."""
    from supercoil import loading
    return loading.load(path, node=node)


def plot(table: "pandas.DataFrame", path: str | Path | None = None) -> Any:
    """Draws position, power and temperature of a table as a matplotlib figure. path: where the picture is written."""
    from supercoil import plots
    return plots.plot(table, path)
