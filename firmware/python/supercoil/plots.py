"""A figure of what a muscle did: position, power, temperature. Needs matplotlib."""

from pathlib import Path
from typing import Any

import pandas

_PANELS = (
    ("mm", 1e3, (("position", ("Measurement.position_m", "measured_m", "position_m")),
                 ("reference", ("Tracking.reference_m", "reference_m")))),
    ("W", 1.0, (("applied", ("Power.applied_W", "applied_power_W", "applied_W")),)),
    ("°C at least, at most", 1.0, (("coldest", ("Temperature.coldest_C", "coldest_C")),
                                   ("hottest", ("Temperature.hottest_C", "hottest_C")))),
)


def plot(table: pandas.DataFrame, path: str | Path | None = None) -> Any:
    """Draws a table of load() or of Recording.table(); what it lacks is left out. path: where the picture is written.
    Returns matplotlib's figure."""
    from matplotlib.figure import Figure
    figure = Figure(figsize=(9, 7), layout="constrained")
    axes = figure.subplots(len(_PANELS), sharex=True)
    for panel, (unit, scale, lines) in zip(axes, _PANELS, strict=True):
        for label, names in lines:
            if (column := next((name for name in names if name in table), None)) is not None:
                values = table[column].dropna()
                panel.plot(values.index, values * scale, label=label)
        panel.set_ylabel(unit)
        panel.grid(alpha=0.3)
        if panel.lines:
            panel.legend(loc="upper right")
    axes[-1].set_xlabel("s")
    if path is not None:
        figure.savefig(path)
    return figure
