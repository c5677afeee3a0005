"""docs/configuration.md, scenarios.md, campaigns.md and tuning.md say of every key what the programs say;
toolchain/generate-keys notices when they do not."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAMS = pathlib.Path(os.environ["PROGRAMS"])
sys.path.insert(0, str(ROOT / "toolchain" / "keys"))
from pages import SEEN, Page
from tuning import TuningPage


class Keys(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.seen = {name: seen(PROGRAMS) for name, seen in SEEN.items()}

    def filled(self, name, old, new):
        """The page with a change of its text, and as the programs would have it."""
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, name)
            text = (ROOT / "docs" / name).read_text()
            self.assertIn(old, text)
            page.write_text(text.replace(old, new, 1))
            filled = Page(page, self.seen[name], PROGRAMS) if name in self.seen else TuningPage(page, PROGRAMS)
            filled.fill()
            return filled

    def said_of(self, name, old, new):
        page = self.filled(name, old, new)
        return "\n".join([*page.problems, *page.differences])

    def test_pages_agree_with_the_programs(self):
        done = subprocess.run([ROOT / "toolchain/generate-keys", "--check", PROGRAMS], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)

    def test_wrong_default_or_range_is_filled_in(self):
        right = (ROOT / "docs/configuration.md").read_text().splitlines()
        page = self.filled("configuration.md",
                           "| `late_in_a_row` | 5 | 1 to 1000 |", "| `late_in_a_row` | 6 | 2 to 900; x |")
        self.assertEqual([line for line in page.written if line not in right],
                         ["| `late_in_a_row` | 5 | 1 to 1000; x | this many consecutive late ticks are a fault |"])
        right = (ROOT / "docs/scenarios.md").read_text().splitlines()
        page = self.filled("scenarios.md",
                           "lag_s = 2.0               # [0 to 1000] time", "lag_s = 3.0               # time")
        self.assertEqual([line.partition(";")[0] for line in page.written if line not in right],
                         ["lag_s = 2                 # [0 to 1000] time constant"])

    def test_key_that_does_not_exist_is_named(self):
        self.assertIn("late_in_row: is not a key of board",
                      self.said_of("configuration.md", "`late_in_a_row`", "`late_in_row`"))
        self.assertIn("integral_W_per_m_s: is not a key of kind pd_ff",
                      self.said_of("scenarios.md", "`proportional_W_per_m`, `integral_W_per_m_s` | `pi` |",
                                   "`proportional_W_per_m`, `integral_W_per_m_s` | `pi`, `pd_ff` |"))

    def test_key_without_a_row_is_named(self):
        self.assertIn("configuration.md: has no row for board.late_in_a_row",
                      self.said_of("configuration.md", "`late_in_a_row`", "`late_ms`"))
        self.assertIn("scenarios.md: has no row for controller.learn, kind learned_ff",
                      self.said_of("scenarios.md", "| `learn` |", "| `find_period` |"))

    def test_keys_of_a_study_are_compared_too(self):
        right = (ROOT / "docs/campaigns.md").read_text().splitlines()
        page = self.filled("campaigns.md", "| `seed` | 1 | 0 to 2147483647 |", "| `seed` | 0 | |")
        self.assertEqual([line for line in page.written if line not in right], [])
        self.assertEqual(len(page.differences), 1)
        self.assertIn("sample: is not a key of study", self.said_of("campaigns.md", "`sampling`", "`sample`"))
        self.assertIn("has no row for draw.log_uniform", self.said_of("campaigns.md", "| `log_uniform` |", "| `list` |"))

    def test_what_a_tuned_value_may_be_is_filled_in(self):
        right = (ROOT / "docs/tuning.md").read_text().splitlines()
        page = self.filled("tuning.md", "| `window_s` | s | 0.1 to 3600 |", "| `window_s` | s | 0 to 60 |")
        self.assertEqual(([line for line in page.written if line not in right], len(page.differences), page.problems),
                         ([], 1, []))
        self.assertIn("window_ms: must be values", self.said_of("tuning.md", "`window_s`", "`window_ms`"))
        self.assertIn("has no row for change_W", self.said_of("tuning.md", "| `change_W` | W |", "| `hold_s` | s |"))
        self.assertIn("change_W, hold_s: must be values that may be the same",
                      self.said_of("tuning.md", "| `change_W` |", "| `change_W`, `hold_s` |"))

    def test_part_of_a_default_or_range_that_depends_on_other_keys_is_compared(self):
        self.assertIn("`late_ms`: the range [0.01 to a tick] does not say 0.001",
                      self.said_of("configuration.md", "0.001 to a tick", "0.01 to a tick"))
        self.assertIn("`sigma_gain`: the default is never 40, but ",
                      self.said_of("scenarios.md", "| `sigma_gain` | `a` | 80;", "| `sigma_gain` | `a` | 40;"))


if __name__ == "__main__":
    unittest.main()
