"""The page's dialog of setup in a real browser, and a simulated board that it sets up, for tests."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import accessibility_test
from page_test import Page, TRIES
from programs import BIN, ROOT, SLACK_S, SUPERCOIL, Program, command, free_ports, monitor
from selenium.webdriver.common.keys import Keys

EXAMPLE = ROOT / "firmware" / "io" / "config" / "examples" / "raspberry-pi-pwm-ads1115.toml"
SIMULATOR = os.environ.get("SUPERCOIL_SIM", BIN / "supercoil-sim")
SUPPLY_V = 12.0
# Of the paper's muscle.
ANSWERS = {"cold_resistance_Ohm": 10, "load_g": 90, "stretch_weight_g": 100, "stretch_mm": 55, "heated_W": 2.0,
           "heated_mm": 13, "half_cooling_s": 1.3, "thread_g": 0.1, "heated_K": 0, "max_W": 4.5, "max_travel_mm": 25,
           "uncertainty_percent": 30}
STEPS = ("describe", "doctor", "senses", "calibrate", "scale", "limits", "identify", "gains", "move")
STEP_S = 240.0


class Wizard(Page):
    """The page's dialog of setup, as a person uses it."""

    def step(self, name):
        return self.run(f"""const step = [...document.querySelectorAll("#setup > ol > li")][{STEPS.index(name)}] ?? document.createElement("li");
            return {{ text: step.textContent, found: step.querySelector("table")?.textContent ?? "",
                      problem: step.querySelector("[role=alert]")?.textContent ?? "", runs: step.classList.contains("runs"),
                      lines: [...step.querySelectorAll(".lines li")].map((li) => li.textContent) }}""")

    def press(self, text):
        self.run(f"""[...document.querySelectorAll("#setup button")].find((b) => b.textContent === "{text}").click()""")

    def begin(self, name):
        again = self.step(name)["found"] != ""
        self.press(f"{name} again" if again else f"begin {name}")
        self.wait(lambda: self.step(name)["runs"] or self.over(name), SLACK_S, f"{name} begins")

    def over(self, name):
        step = self.step(name)
        return not step["runs"] and (step["found"] or step["problem"])

    def ended(self, name, patience_s=STEP_S):
        self.wait(lambda: self.over(name), patience_s, f"{name} ends")
        return self.step(name)

    def question_key(self):
        """The key of the current question."""
        return self.run("""return document.querySelector("#setup form input")?.id.slice(6) ?? "" """)

    def in_view(self, place):
        """Not scrolled out of the dialog."""
        return self.run(f"""const part = document.querySelector("{place}").getBoundingClientRect();
            const dialog = document.querySelector("#setup").getBoundingClientRect();
            return part.top >= dialog.top && part.bottom <= dialog.bottom""")

    def answer(self, key, value):
        self.wait(lambda: self.question_key() == key, SLACK_S, f"{key} is asked")
        self.find("#setup form input").send_keys(str(value), Keys.ENTER)

    def describe(self):
        self.begin("describe")
        self.answer("nameplate", 0)
        for key, value in ANSWERS.items():
            self.answer(key, value)
        return self.ended("describe", SLACK_S)


class SetupCase(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "board.toml"
        # Room for a muscle that rests lower in the coldest air than where its zero was taken.
        self.text = EXAMPLE.read_text().replace("min_m = -0.001", "min_m = -0.012")
        self.file.write_text(self.text)
        self.boards = []

    def start_board(self, port=0, scenario="bench"):
        """With the file as it is now, and what it learned before; at first its senses were never compared with a meter."""
        learned = self.file.with_name("learned")
        learned.mkdir(exist_ok=True)
        board = Program([SIMULATOR, "run", scenario, "--board", self.file, "--real-time", "--learned", learned,
                         "--can", f"socketcand:{port or free_ports()}"], r"serving can0 on 127\.0\.0\.1:(\d+)")
        self.addCleanup(board.stop)
        return board

    def wizard(self, source, width=1440):
        self.monitor = monitor(source, "--setup", self.file)
        self.addCleanup(self.monitor.stop)
        page = Wizard(width=width)
        self.addCleanup(page.__exit__)
        page.open(self.monitor.found[0])
        page.click("#open-setup")
        page.wait(lambda: page.text("#setup h3") == "describe", SLACK_S, "the steps are shown")
        return page

    def described(self):
        """A board that runs with a complete file, and the page."""
        done = subprocess.run([SUPERCOIL, "setup", "describe", "--config", self.file, "--script", self.script()], capture_output=True,
                              text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        board = self.start_board()
        self.source = f"socketcand:{board.found[1]}"
        return self.wizard(self.source)

    def script(self):
        path = self.file.with_name("answers.toml")
        path.write_text("[muscle]\n" + "".join(f"{key} = {value}\n" for key, value in ANSWERS.items()))
        return path

    def record(self):
        return json.loads(self.file.with_name("board.toml.setup.json").read_text())["channel-1"]

    def run_step(self, page, name, after_begin=lambda: None):
        """Repeats when the machine stalls so long that a command expires, as it must."""
        for _ in range(TRIES):
            command(self.source, "1", "reset")
            page.begin(name)
            try:
                after_begin()
            except AssertionError:
                if "command_timeout" not in page.step(name)["problem"]:
                    raise
            step = page.ended(name)
            if not step["problem"]:
                return step
            print(f"{name}: {step['problem']}")
        raise AssertionError(f"{name} did not end well in {TRIES} tries")

    def audit(self, page, view):
        """Audits the dialog as it is now, with everything that can be opened."""
        if not page.run("return 'axe' in window"):
            page.run(accessibility_test.AXE)
        page.run("for (const details of document.querySelectorAll('#setup details')) details.open = true")
        # axe ignores what is scrolled out of view, so the screen has room for everything.
        page.run("for (const lines of document.querySelectorAll('#setup .lines')) lines.style.maxHeight = 'none'")
        for width, scheme in ((1440, "light"), (1440, "dark"), (390, "light"), (390, "dark")):
            accessibility_test.AccessibilityTest.settle(self, page, width, 5000, scheme, width < 600)
            with self.subTest(view, width=width, scheme=scheme):
                self.assertEqual(page.driver.execute_async_script(accessibility_test.AUDIT, "#setup"), [])
                self.assertLessEqual(page.run("return document.querySelector('#setup').scrollWidth - document.querySelector('#setup').clientWidth"), 0)
        accessibility_test.AccessibilityTest.settle(self, page, 1440, 1000)
