"""The page leads from a muscle to one that follows, in a real browser, over a simulated board that runs in real time.

    setup_test.py                the tests
    setup_test.py --pictures     takes the pictures of docs/setup.md instead
Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import json
import re
import subprocess
import sys
import time
import unittest
import urllib.request

from page_test import PICTURES, TRIES
from programs import SLACK_S, SUPERCOIL, command, monitor
from setup_page import EXAMPLE, STEPS, STEP_S, SUPPLY_V, SetupCase


class SetupTest(SetupCase):
    def test_complete_setup(self):
        audited = set()

        def see(page, view):
            # limits pulls meanwhile, and asks as the others do.
            if view in audited | {"question", "limits"}:
                return
            audited.add(view)
            if view == "identify":
                page.wait(lambda: " %" in page.text("#setup .progress span"), STEP_S, "its progress")
            self.audit(page, view)

        self.follow_all_steps(see)
        self.assertEqual(audited, {"described", "senses", "identify", "gains", "moved"})

    def follow_all_steps(self, see):
        board = self.start_board()
        port = board.found[1]
        self.source = f"socketcand:{port}"
        page = self.wizard(self.source)
        page.begin("describe")
        page.wait(page.question_key, SLACK_S, "a question")
        see(page, "question")
        page.press("end describe")
        page.ended("describe", SLACK_S)
        described = page.describe()
        self.assertIn("muscle.stiffness", described["found"])
        self.assertIn("stiffness_N_per_m = 17.84", self.file.read_text())
        self.assertIn("start the board with it", described["text"])
        page.begin("calibrate")
        refused = page.ended("calibrate")["problem"]
        self.assertIn("the board is not running with this file: channel 1: muscle.", refused)
        self.assertIn("muscle.stiffness_N_per_m = 17.84 (the board: ", refused)
        board.stop()
        board = self.start_board(port)

        def compare():
            for _ in range(2):
                page.answer("supply_V", SUPPLY_V)
                page.wait(lambda: page.question_key() == "current_A", SLACK_S, "amperes are asked")
                power_W = float(re.search(r"gets ([\d.]+) W", page.step("senses")["lines"][-2])[1])
                see(page, "senses")
                page.answer("current_A", f"{power_W / SUPPLY_V:.5f}")
                page.wait(lambda: page.question_key() != "current_A", SLACK_S, "the amperes are taken")

        see(page, "described")
        looked = self.run_step(page, "doctor")
        self.assertIn("run supercoil doctor on the board itself", looked["lines"][0])
        senses = self.run_step(page, "senses", compare)
        self.assertIn("the true power is 0.9", " ".join(senses["lines"]))
        calibrated = self.run_step(page, "calibrate")
        self.assertRegex(" ".join(calibrated["lines"]), r"cold resistance: (9\.9|10)\S* Ohm \(configured: 10, ")

        def answer_at_8_mm():
            page.wait(lambda: any(float(at) > 8.0 for at in re.findall(r"([\d.]+) mm at", " ".join(page.step("limits")["lines"]))),
                      STEP_S, "it pulls")
            see(page, "limits")
            # Each line redraws the question, so an element that was found may be gone when it is used.
            page.run("""document.querySelector("#setup form input").value = "1" """)
            lines = len(page.step("limits")["lines"])
            page.wait(lambda: len(page.step("limits")["lines"]) > lines, STEP_S, "another line")
            self.assertEqual(page.run("""return document.querySelector("#setup form input").value"""), "1")
            page.press("next")

        limits = self.run_step(page, "limits", answer_at_8_mm)
        limit = re.search(r"let go at [\d.]+ mm limit: ([\d.]+) mm \(configured: 25 mm\)", " ".join(limits["lines"]))
        self.assertIn(f"max_travel_m = {1e-3 * float(limit[1]):.4g}", self.file.read_text())
        self.assertIn("start the board with it", limits["text"])
        board.stop()
        self.start_board(port)
        identified = self.run_step(page, "identify", lambda: see(page, "identify"))
        self.assertRegex(" ".join(identified["lines"]), r"stiffness_N_per_m: \S+ (± \S+ % )?\(configured: 17\.84, ")
        self.assert_card_shows_deviations(page, identified["lines"])
        tuned = subprocess.run([SUPERCOIL, "tune", "1", "bandwidth_rad_per_s=3", "--can", self.source], capture_output=True, timeout=SLACK_S)
        self.assertEqual(tuned.returncode, 0)

        def take():
            page.wait(lambda: page.question_key() == "take_gains", SLACK_S, "whether to take the recommended controller")
            see(page, "gains")
            page.answer("take_gains", 1)

        gains = self.run_step(page, "gains", take)
        self.assertRegex(" ".join(gains["lines"]), "bandwidth_rad_per_s = 3, .*recommended for this muscle: .*taken over, and stored")
        moved = self.run_step(page, "move")
        self.assertRegex(" ".join(moved["lines"]), "promised: .*followed within .* um rms: the promise is kept")
        see(page, "moved")
        self.assertEqual(set(self.record()), {"describe", "doctor", "senses", "calibrate", "limits", "identify", "gains", "move"})
        state = command(self.source, "state").stdout
        self.assertRegex(state, "node 1: disarmed")
        self.assertEqual(page.errors(), [])

    def assert_card_shows_deviations(self, page, lines):
        """The card of the muscle in use has the deviations that the step reported."""
        def deviation(title):
            return page.run(f"""return [...document.querySelectorAll("section[aria-label='muscle in use, node 1'] tbody tr")]
                .find((row) => row.firstChild.textContent === "{title}").children[3].textContent""")

        for title in ("time constant", "gain"):
            reported = re.search(rf"{title}: \S+ \S+ ± (\S+) %", " ".join(lines))
            page.wait(lambda: deviation(title) != "–", SLACK_S, f"the deviation of the {title}")
            self.assertAlmostEqual(float(deviation(title).split()[1]), float(reported[1]), delta=0.05 * float(reported[1]))

    def test_an_invalid_answer_is_refused_and_requested_again(self):
        page = self.wizard(f"socketcand:{self.start_board().found[1]}")
        page.begin("describe")
        page.answer("nameplate", 0)
        page.answer("cold_resistance_Ohm", "10Ohm")  # a space is STOP, as everywhere
        page.wait(lambda: "'10Ohm' is refused: it must be a number from 0.1 to 10000" in page.text("#setup form [role=alert]"), SLACK_S, "refused")
        self.assertTrue(page.in_view("#setup form [role=alert]"))
        self.assertEqual(page.find("#setup form input").get_attribute("aria-describedby"), page.find("#setup form [role=alert]").get_attribute("id"))
        self.assertEqual(page.question_key(), "cold_resistance_Ohm")
        page.press("end describe")
        step = page.ended("describe", SLACK_S)
        self.assertEqual(step["problem"], "interrupted: ended on the page")
        self.assertEqual(self.file.read_text(), self.text)

    def test_a_late_response_keeps_the_typed_answer(self):
        page = self.wizard(f"socketcand:{self.start_board().found[1]}")
        # A request from before the step began is answered after the question is shown.
        page.run("""const now = window.fetch;
            window.fetch = async (...request) => {
              const answer = await now(...request);
              if (request[0] === "/api/setup" && !window.late) {
                window.late = true;
                await new Promise((go_on) => setTimeout(go_on, 4000));
              }
              return answer;
            };""")
        page.wait(lambda: page.run("return window.late === true"), SLACK_S, "the page asks")
        page.begin("describe")
        page.wait(page.question_key, SLACK_S, "a question")
        page.find("#setup form input").send_keys("12")
        time.sleep(5.0)
        self.assertEqual(page.find("#setup form input").get_attribute("value"), "12")

    def test_manual_control_is_released_when_a_step_begins(self):
        for _ in range(TRIES):
            page = self.described()
            page.click("#open-setup")
            page.bring_to(3.0)
            page.click("#open-setup")
            page.begin("scale")
            page.wait(lambda page=page: page.text(".manual .notice") != "", SLACK_S, "the page says who has the muscle")
            if "setup took over" in page.text(".manual .notice"):
                return
            self.assertIn("command expired", page.text(".manual .notice"))  # the machine stalled before the step began
            self.doCleanups()
            self.setUp()
        raise AssertionError(f"setup did not take over in {TRIES} tries")

    def test_setup_pages_are_accessible(self):
        page = self.described()
        page.begin("describe")
        page.answer("nameplate", 0)
        page.wait(lambda: page.question_key() == "cold_resistance_Ohm", SLACK_S, "a question")
        self.audit(page, "question")
        page.answer("cold_resistance_Ohm", "10Ohm")
        page.wait(lambda: "is refused" in page.text("#setup form"), SLACK_S, "refused")
        self.audit(page, "refused")
        page.press("end describe")
        page.ended("describe", SLACK_S)
        self.audit(page, "problem")

    def test_undo_restores_the_file(self):
        page = self.described()
        self.assertNotEqual(self.file.read_text(), self.text)
        described = self.file.read_text()
        self.file.write_text(described + "# by hand\n")
        page.press("undo the last change")
        page.wait(lambda: "was changed after describe of channel 1 wrote it" in page.text("#setup > .answer"), SLACK_S, "refused")
        self.file.write_text(described)
        page.press("undo the last change")
        page.wait(lambda: "as it was before describe of channel 1" in page.text("#setup > .answer"), SLACK_S, "undone")
        self.assertEqual(self.file.read_text(), self.text)
        self.assertEqual(page.step("describe")["found"], "")

    def test_the_remaining_time_is_shown(self):
        page = self.described()
        self.run_step(page, "calibrate")
        for _ in range(TRIES):
            page.begin("identify")
            page.wait(lambda: " left" in page.text("#setup .progress span") or page.over("identify"), STEP_S, "the time that is left")
            progress = page.text("#setup .progress span") if not page.over("identify") else ""
            if progress:
                break
        self.assertRegex(progress, r"^\s*identify, \d+ %, \d+ (s|min) left$")
        page.press("end identify")
        page.ended("identify", SLACK_S)

    def test_stop_ends_a_step_and_disarms(self):
        page = self.described()
        self.run_step(page, "calibrate")
        page.begin("identify")
        page.wait(lambda: page.state() == "active" or page.over("identify"), SLACK_S, "heats")
        page.click("#stop")
        step = page.ended("identify", 3 * SLACK_S)
        self.assertIn("STOP", step["problem"])
        self.assertRegex(command(self.source, "state").stdout, "node 1: disarmed")
        self.assertNotIn("identify", self.record())

    def test_a_step_ends_when_the_page_is_closed(self):
        page = self.described()
        self.run_step(page, "calibrate")
        page.begin("identify")
        page.wait(lambda: page.state() == "active" or page.over("identify"), SLACK_S, "heats")
        page.driver.get("about:blank")
        time.sleep(12.0)
        self.assertRegex(command(self.source, "state").stdout, "node 1: disarmed")
        page.open(self.monitor.found[0] if self.monitor.found[2] else self.monitor.found[1])
        page.click("#open-setup")
        page.wait(lambda: page.step("identify")["problem"] != "", SLACK_S, "told")
        self.assertIn("interrupted: no page watched it", page.step("identify")["problem"])

    def test_an_antagonist_lacks_the_agonists_steps(self):
        self.file.write_text((EXAMPLE.parent / "joint-as5600-ads1115.toml").read_text())
        board = self.start_board(scenario="joint-bench")
        for channel, missing in (("1", {"scale"}), ("2", {"scale", "gains", "move"})):
            program = monitor(f"socketcand:{board.found[1]}", "--setup", self.file, "--channel", channel)
            self.addCleanup(program.stop)
            with urllib.request.urlopen(f"{program.found[1]}api/setup", timeout=SLACK_S) as answer:
                names = [step["name"] for step in json.load(answer)["steps"]]
            self.assertEqual(names, [name for name in STEPS if name not in missing])
            program.stop()

    def test_invalid_setup_options_are_rejected_at_the_start(self):
        for words, expected in ((("--setup", "missing.toml"), "missing.toml"),
                            (("--setup", self.file, "--channel", "3"), "board.toml has no channel 3, but 2"),
                            (("--setup", self.file, "--read-only"), "--read-only excludes --setup"),
                            (("--channel", "2"), "--channel requires --setup")):
            done = subprocess.run([SUPERCOIL, "monitor", "socketcand:29536", *words], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(expected, done.stderr)
        log = self.file.with_name("can.log")
        log.write_text("(1.000000) can0 101#00\n")
        done = subprocess.run([SUPERCOIL, "monitor", log, "--setup", self.file], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is a log: --setup needs a board on a bus", done.stderr)


class Pictures(SetupTest):
    """The sequence of docs/setup.md; a test run does not find it."""

    def runTest(self):
        def see(page, name):
            page.screen(1120, 860)
            time.sleep(20.0 if name == "identify" else 1.0)
            page.driver.save_screenshot(str(PICTURES / f"setup-{name}.png"))

        self.follow_all_steps(see)


if __name__ == "__main__":
    if "--pictures" in sys.argv:
        unittest.TextTestRunner(verbosity=2).run(Pictures())
    else:
        unittest.main(verbosity=2, defaultTest="SetupTest")
