"""report.html of a campaign in Chromium: one file with campaign.csv's figures; no text of a study is taken for markup."""

import base64
import csv
import json
import pathlib
import shlex
import subprocess
import tempfile
import unittest
from xml.etree import ElementTree

from browser import Browser
from sim_program import PROGRAM

ROOT = pathlib.Path(__file__).resolve().parents[4]
AXE = ROOT / "toolchain/page/node_modules/axe-core/axe.min.js"
LAYOUT = ROOT / "tests/monitor/layout.js"
NAME = 'a<b>&"c"'
ABOUT = "<script>alert(1)</script> & 'more'"
STUDY = f"""# {ABOUT}
[study]
runs = 12
scenario = "pwm"
controllers = ["pi", "my <i>.toml"]
window_s = [1.0, 2.0]
[goals]
tracking_rms_m = 1e-5
hottest_C = 160.0
[scenario.simulation]
duration_s = 2.0
[[draw]]
name = "<u>stiffness"
keys = "plant.stiffness_N_per_m"
log_uniform = [8.0, 40.0]
[[draw]]
keys = "reference.offset_m"
uniform = [0.008, 0.0125]
[[draw]]
name = "a very long name of a draw that says nothing of what it draws"
keys = "sensor.position.noise_rms_m"
list = [1e-6, 1e-5]
"""
AUDIT = """const done = arguments[0];
axe.run({ resultTypes: ["violations"] }).then(({ violations }) =>
    done(violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 160)}`))))"""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        path = pathlib.Path(folder.name)
        (path / f"{NAME}.toml").write_text(STUDY)
        (path / "my <i>.toml").write_text("controller.kind = 'pd_ff'\n")
        subprocess.run([PROGRAM, "campaign", f"{NAME}.toml", "--out", "out"], cwd=path, check=True, capture_output=True)
        cls.out = path / "out"
        cls.text = (cls.out / "report.html").read_text()
        cls.page = ElementTree.fromstring(cls.text)

    def rows(self, table):
        return [row.findall("td") for row in self.page.findall(f".//table[@id='{table}']/tbody/tr")]

    def test_names_of_a_study_are_escaped(self):
        self.assertEqual(self.page.findtext(".//h1"), NAME)
        self.assertEqual(self.page.findtext(".//main/p"), ABOUT)
        tags = {element.tag for element in self.page.iter()}
        self.assertEqual(tags & {"script", "i", "u", "b", "link", "iframe"}, set())
        self.assertEqual(self.rows("draws")[0][0].text, "<u>stiffness")
        self.assertIn("my <i>", {row[0].text for row in self.rows("goals")})

    def test_it_states_the_setup_of_the_study(self):
        setup = {row.findtext("th"): row.findtext("td") for row in self.page.findall(".//table[@id='asked']/tbody/tr")}
        first = (self.out / "runs.csv").read_text().split("\n", 1)[0]
        self.assertTrue(first.startswith(f"# {setup['made by']}, "))
        self.assertEqual([setup[what] for what in ("scenario", "runs", "sampling", "controllers", "tracking window")],
                         ["pwm", "12", "sobol, seed 1", "pi, my <i>", "1 to 2 s"])
        self.assertEqual([row[1].text for row in self.rows("draws")],
                         ["log-uniform, 8 to 40", "uniform, 0.008 to 0.0125", "one of 1e-06, 1e-05"])

    def test_figures_match_the_table(self):
        def values(row):
            return [data.get("value") for cell in row for data in cell.findall("data")]

        shown = {(row[0].text, row[1].text): ["", *values(row), "", "", ""] for row in self.rows("shares")}
        shown |= {(row[0].text, row[1].text): values(row) for row in self.rows("goals")}
        with open(self.out / "campaign.csv") as file:
            written = {(line[0], line[1]): line[2:] for line in list(csv.reader(file))[1:]}
        self.assertEqual(shown, written)
        self.assertEqual(len(written), 2 * (2 + 3))

    def test_it_is_a_single_file(self):
        images = self.page.findall(".//img")
        self.assertEqual([element for element in self.page.iter() if element.get("href") or element.tag == "link"], [])
        self.assertEqual(len(images), 1)
        begin = "data:image/svg+xml;base64,"
        source = images[0].get("src")
        self.assertTrue(source.startswith(begin))
        self.assertEqual(base64.b64decode(source[len(begin):]), (self.out / "campaign.svg").read_bytes())
        rest = self.text.replace(source, "")
        for other in ("://", "url(", "@import"):
            self.assertNotIn(other, rest)

    def test_commands_repeat_the_worst_runs(self):
        with open(self.out / "runs.csv") as file:
            next(file)
            ran = {(line["contender"], line["run"]): line for line in csv.DictReader(file)}
        worst = self.rows("worst")
        self.assertEqual({row[0].text for row in worst}, {"pi", "my <i>"})
        for row in (worst[0], worst[-1]):
            program, *arguments = shlex.split(row[3].findtext("code"))
            self.assertEqual(program, "supercoil-sim")
            with tempfile.TemporaryDirectory() as again:
                subprocess.run([PROGRAM, *arguments, "--out", again, "--no-plot", "--no-trace", "--no-can"],
                               cwd=self.out, check=True, capture_output=True)
                summary = json.loads((pathlib.Path(again) / "summary.json").read_text())
            line = ran[row[0].text, row[1].findtext("data")]
            self.assertEqual(summary["tracking_rms_m"], float(line["tracking_rms_m"]))

    def test_it_fits_phones_and_desktops(self):
        with Browser() as browser:
            browser.driver.get((self.out / "report.html").as_uri())
            requests = [url for url in browser.requests() if not url.startswith(("file:", "data:", "chrome:"))]
            self.assertEqual(requests, [])
            browser.run(AXE.read_text())
            browser.run("for (const one of document.querySelectorAll('details')) one.open = true")
            for scheme in ("light", "dark"):
                browser.colours(scheme)
                self.assertEqual(browser.driver.execute_async_script(AUDIT), [])
            for width in (360, 1440):
                browser.screen(width, 900)
                self.assertEqual(browser.driver.execute_script(LAYOUT.read_text(), 0), [], f"at {width} px")
            self.assertEqual(browser.errors(), [])


if __name__ == "__main__":
    unittest.main()
