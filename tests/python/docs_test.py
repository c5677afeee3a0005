"""Every piece of Python on docs/python.md runs, and says what the page says, on the simulated board."""

import doctest
import pathlib
import re
import unittest

from patience import QUICK, STARVED, TRIES

from supercoil import sync

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "python.md"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)


def run_block(text, names):
    if ">>>" not in text:
        exec(compile(text, PAGE.name, "exec"), names)
        return
    test = doctest.DocTestParser().get_doctest(text, names, PAGE.name, str(PAGE), 0)
    try:
        doctest.DebugRunner(verbose=False).run(test, clear_globs=False)
    except doctest.UnexpectedException as unexpected:
        raise unexpected.exc_info[1] from None
    except doctest.DocTestFailure as failure:
        raise AssertionError(f"{failure.example.source}gave {failure.got}instead of {failure.example.want}") from None
    names.update(test.globs)


class Docs(unittest.TestCase):
    def test_the_examples_of_the_page_run(self):
        blocks = BLOCK.findall(PAGE.read_text())
        self.assertGreater(len(blocks), 8)
        for attempt in range(TRIES):
            names = {}
            with sync.Simulation(QUICK, deadline_s=60.0) as simulation:
                try:
                    for block in blocks:
                        # A nearer set point, since a reference model takes its time.
                        run_block(block.replace('"can0"', f'"{simulation.address}"').replace("0.002", "0.0004"), names)
                    return
                except STARVED:
                    if attempt + 1 == TRIES:
                        raise
                finally:
                    if "muscle" in names:
                        names["muscle"].close()


if __name__ == "__main__":
    unittest.main()
