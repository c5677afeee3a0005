"""Units of columns: a name ends with its unit; signals with a unit in the DBC have that one."""

from supercoil.generated import messages

_OF_SIGNAL = {signal.name: signal.unit for layout in messages.LAYOUTS for signal in layout.signals if signal.unit}
# As names end in them, the longest first: J_per_K before K.
_ENDINGS = sorted({(unit.removeprefix("deg").replace("/", "_per_"), unit) for unit in _OF_SIGNAL.values()
                   if " " not in unit} | {("K", "K"), ("Hz", "Hz"), ("deg", "deg")}, key=lambda ending: -len(ending[0]))


def unit_of(column: str) -> str:
    """Empty: it has none."""
    if known := _OF_SIGNAL.get(column):
        return known
    return next((unit for ending, unit in _ENDINGS if column.endswith(f"_{ending}")), "")
