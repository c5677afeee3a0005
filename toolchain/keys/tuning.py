"""docs/tuning.md, compared with what `supercoil tune` says is allowed."""

import re
import subprocess
import sys

from pages import QUOTED, Page, shown

TABLES = {"| value of a controller |": [], "| value of an estimator |": ["--estimator", "0"]}


class TuningPage(Page):
    def __init__(self, path, programs):
        super().__init__(path, {}, programs)

    def fill(self):
        for header, options in TABLES.items():
            number, = [number for number, line in enumerate(self.lines) if line.startswith(header)]
            self.fill_values(number + 2, options)
        return self.find_differences()

    def fill_values(self, number, options):
        left = self.allowed("all", options).split(", ")
        while self.lines[number].startswith("|"):
            start, _, _ = self.lines[number].rsplit("|", 2)
            names = QUOTED.findall(start)
            allowed = {self.allowed(name, options) for name in names if name in left}
            if set(names) <= set(left) and len(allowed) == 1:
                self.written[number] = f"{start}| {allowed.pop()} |"
            else:
                self.wrong(number, f"{', '.join(names)}: must be values that may be the same, of {', '.join(left)}")
            left = [name for name in left if name not in names]
            number += 1
        self.problems += [f"{self.path.name}: has no row for {name}" for name in left]

    def allowed(self, name, options):
        """From the error's text: no board is asked."""
        said = subprocess.run([self.programs / "supercoil", "tune", "1", f"{name}=*", "--socket", "/nowhere", *options],
                              capture_output=True, text=True).stderr
        if limits := re.search(r"must be (\S+) to (\S+)\n", said):
            return " to ".join(shown(float(limit)) for limit in limits.groups())
        if names := re.search(r"there are: (.*)\n", said):
            return names[1]
        sys.exit(f"generate-keys: {name}: {said}")
