"""What was measured, beside what is expected."""

import dataclasses
import sys


@dataclasses.dataclass
class Table:
    wrong: int = 0

    def row(self, what, value, low, high, unit):
        right = value is not None and low <= value <= high
        self.wrong += not right
        shown = "none" if value is None else f"{value:.3f}"
        print(f"{'ok   ' if right else 'WRONG'} {what:62} {shown:>9} {unit:4} {low:g} to {high:g}")

    def judge(self, name, part, run):
        """Adds the rows of part(self, run). Ends the program with 2 when the board reported too little for them."""
        try:
            part(self, run)
        except (KeyError, IndexError, TypeError, AttributeError, ValueError, OSError) as error:
            print(f"{run.console}\n{name}: the board did not do its part: {error!r}", file=sys.stderr)
            sys.exit(2)
        print(f"      {name}: {run.wall_s:.1f} s of this machine\n")

    def end(self):
        """Ends the program: with 1 if any row is wrong."""
        sys.exit(1 if self.wrong else 0)
