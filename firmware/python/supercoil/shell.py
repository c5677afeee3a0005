"""python -m supercoil: a muscle at the Python prompt."""

import argparse
import code
import contextlib
import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import supercoil
from supercoil import sync
from supercoil.recording import Recording

if TYPE_CHECKING:
    import pandas

_MAX_FRAMES = 200_000  # ten minutes of one node
_NAMES = """\
muscle              arm(), move_to(0.010), hold(10), rest(), disarm(), reset(), identify(), tuning(), telemetry ...
table(10)           what was heard in the last 10 s, as a table of pandas
plot(10)            the same as a picture, supercoil.png; plot(10, "my.svg")
supercoil           the package: supercoil.discover("can0"), supercoil.Setting ...
help(muscle.arm)    and so on; Ctrl-D ends it, and disarms the muscle"""


class Shell:
    """The names that its prompt offers."""

    def __init__(self, muscle: sync.Muscle, recording: Recording) -> None:
        self._muscle = muscle
        self._recording = recording

    def table(self, seconds: float = 10.0) -> "pandas.DataFrame":
        rows = self._recording.table()
        return rows[rows.index >= rows.index.max() - seconds] if len(rows) else rows

    def plot(self, seconds: float = 10.0, path: str | Path = "supercoil.png") -> Path:
        from supercoil.plots import plot
        plot(self.table(seconds), path)
        return Path(path)

    def names(self) -> dict[str, Any]:
        of_package = ("Setting", "Quantity", "messages", "faults", "refusals")
        return {"supercoil": supercoil, "muscle": self._muscle, "table": self.table, "plot": self.plot,
                **{name: getattr(supercoil, name) for name in of_package}}


def _load_libraries() -> None:
    """Called before anything heats: loading them first can hold Python's lock for as long as a command lasts."""
    for name in ("supercoil.tables", "matplotlib.figure", "matplotlib.backends.backend_agg"):
        with contextlib.suppress(ImportError):
            importlib.import_module(name)


def _talk(muscle: sync.Muscle) -> None:
    with contextlib.suppress(ImportError):
        import readline  # noqa: F401
    with muscle.record(most_frames=_MAX_FRAMES) as recording:
        shell = Shell(muscle, recording)
        code.interact(banner=f"node {muscle.node} is {muscle.state}; after {muscle.deadline_s:g} s without a command "
                      f"it is let go\n{_NAMES}", local=shell.names(), exitmsg="")


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser("python -m supercoil", description="a muscle at Python's prompt")
    parser.add_argument("address", nargs="?", help="can0; socketcand:[HOST:]PORT; INTERFACE:CHANNEL of python-can; "
                        "the path of the board's socket")
    parser.add_argument("--node", type=int, default=1, help="node of the muscle (default 1)")
    parser.add_argument("--simulation", metavar="SCENARIO", help="instead of an address: start supercoil-sim")
    parser.add_argument("--deadline", type=float, default=60.0, metavar="S",
                        help="seconds for which the muscle is held while nothing is typed (default 60)")
    options = parser.parse_args(arguments)
    if (options.address is None) == (options.simulation is None):
        parser.error("an address or --simulation SCENARIO is needed")
    _load_libraries()
    try:
        if options.simulation:
            with sync.Simulation(options.simulation, node=options.node, deadline_s=options.deadline) as simulation:
                _talk(simulation.muscle)
        else:
            with sync.Muscle(options.address, options.node, deadline_s=options.deadline) as muscle:
                _talk(muscle)
    except supercoil.SupercoilError as error:
        print(f"supercoil: {error}")
        return 1
    return 0
