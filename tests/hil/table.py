"""What was measured, beside what is right."""

import dataclasses


@dataclasses.dataclass
class Table:
    wrong: int = 0

    def row(self, what, value, low, high, unit):
        right = value is not None and low <= value <= high
        self.wrong += not right
        shown = "none" if value is None else f"{value:.3f}"
        print(f"{'ok   ' if right else 'WRONG'} {what:62} {shown:>9} {unit:4} {low:g} to {high:g}")
