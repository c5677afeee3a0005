"""A controller is tuned while the board runs: by `supercoil tune` over a bus, and on the live page in a real browser.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import json
import subprocess
import unittest

from page_test import NEAR_MM, PageCase, TARGET_MM
from programs import SLACK_S, SUPERCOIL, command, until

CARD = "details[aria-label='controllers of node 1']"
ANSWER_S = 30.0  # hundreds of questions and answers over the bus, on a machine that does other work


class TuneCommand(PageCase):
    def tune(self, *words, channel="1"):
        return subprocess.run([SUPERCOIL, "tune", channel, *words, "--can", self.source], capture_output=True, text=True,
                              timeout=SLACK_S)

    def values(self, *words):
        done = self.tune(*words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        controller, = json.loads(done.stdout)["controllers"]
        return controller

    def tearDown(self):
        self.values("--from", "configured", "--store")

    def test_values_are_used_stored_and_restored(self):
        before = self.values()
        self.assertEqual(before["kind"]["in_use"], "mrac")
        self.assertEqual(before["shape_reference"]["configured"], False)
        changed = self.values("adaptation_scale=2.1", "shape_reference=true")
        self.assertEqual(changed["adaptation_scale"], {"prepared": 2.1, "in_use": 2.1, "configured": 1.0, "stored": 1.0})
        self.assertIs(changed["shape_reference"]["in_use"], True)
        self.assertEqual(self.values("--store")["adaptation_scale"]["stored"], 2.1)
        self.assertEqual(self.values("--clear")["adaptation_scale"]["stored"], 1.0)
        self.assertEqual(self.values("--from", "configured")["adaptation_scale"]["in_use"], 1.0)

    def test_mrac_constants_can_be_tuned(self):
        changed = self.values("gain_6=90", "lambda_1=44", "p0_rad_per_s=4.5", "model_pole_1_rad_per_s=4.5", "freeze_when_limited=false")
        self.assertEqual([changed[name]["in_use"] for name in ("gain_6", "lambda_1", "p0_rad_per_s", "freeze_when_limited")],
                         [90.0, 44.0, 4.5, False])
        # The proof of its stability requires a model with the same poles.
        self.assertIn("unsuitable", self.tune("p0_rad_per_s=5").stderr)
        self.assertIn("unsuitable", self.tune("gain_1=1", "damping=-1").stderr)

    def test_differing_values_have_a_star(self):
        lines = self.tune("kind=pi", "integral_W_per_m_s=900").stdout.splitlines()
        self.assertEqual(lines[0], "controller 0: pi")
        starred = {line[1:].split()[0]: line[1:].split()[1:] for line in lines if line.startswith("*")}
        self.assertEqual(starred["kind"], ["pi", "mrac", "mrac", "pi"])
        self.assertEqual(starred["integral_W_per_m_s"], ["900", "-", "-", "900"])

    def test_prepared_values_wait_for_tune(self):
        self.assertEqual(self.values("adaptation_scale=3", "--prepare")["adaptation_scale"]["in_use"], 1.0)
        done = subprocess.run([SUPERCOIL, "command", "1", "tune", "0", "--can", self.source], timeout=SLACK_S)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.values()["adaptation_scale"]["in_use"], 3.0)

    def test_an_estimator_is_tuned_by_its_number(self):
        def values(*words):
            done = self.tune("--estimator", "0", *words, "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            estimator, = json.loads(done.stdout)["estimators"]
            return estimator

        before = values()
        self.assertEqual((before["estimator"], before["kind"]["in_use"]), (0, "gradient"))
        after = values("trusted_error=0.1")
        self.assertEqual(after["trusted_error"] | {"configured": None}, {"prepared": 0.1, "in_use": 0.1, "configured": None,
                                                                         "stored": before["trusted_error"]["configured"]})
        lines = self.tune("--estimator", "0", "kind=least_squares", "forgetting_s=20").stdout.splitlines()
        lines_of_estimator = lines[lines.index("estimator 0: least_squares"):]
        self.assertIn(["*", "forgetting_s", "20", "-", "-", "20"], [line.split() for line in lines_of_estimator])
        self.assertEqual(values("--from", "configured", "--store")["kind"]["in_use"], "gradient")

    def test_a_kind_selects_its_place(self):
        self.assertEqual(self.values("--controller", "mrac", "adaptation_scale=3", "--prepare")["adaptation_scale"]["in_use"], 1.0)
        for words in (("tune", "mrac"), ("controller", "mrac"), ("tune", "gradient"), ("estimator", "gradient")):
            done = command(self.source, "1", *words)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        self.assertEqual(self.values()["adaptation_scale"]["in_use"], 3.0)
        self.assertEqual(self.tune("--estimator", "gradient", "trusted_error=0.1").returncode, 0)
        self.tune("--estimator", "0", "--from", "configured")

    def test_another_commanding_program_is_reported(self):
        until(lambda: command(self.source, "1", "arm").returncode == 0)
        held = subprocess.Popen([SUPERCOIL, "command", "1", "power", "0.1", "--hold", "--can", self.source])
        until(lambda: "node 1: active" in command(self.source, "state").stdout)
        error = self.tune("adaptation_scale=2").stderr
        held.terminate()
        held.wait()
        self.assertEqual(error, "supercoil: nothing was prepared: refused: not_lease_holder: another program commands this muscle\n")

    def test_errors_are_reported(self):
        for words, status, expected in ((("volume=1",), 2, "volume cannot be tuned; there are: kind, "),
                                    (("bandwith=3",), 2, "bandwith cannot be tuned; did you mean bandwidth_rad_per_s (the unit is part of the name)?"),
                                    (("gain=",), 2, "gain cannot be tuned; did you mean gain_1?"),
                                    (("gain_1=",), 2, "gain_1: has no value: must be 1e-06 to 1e+12"),
                                    (("kind=",), 2, "kind: has no value: there are: "),
                                    (("=3",), 2, "=3: write NAME=VALUE"),
                                    (("max_power_W=9",), 2, "max_power_W is a setting, which tune does not change: "
                                     f"supercoil setting 1 max_power_W 9 --can {self.source}"),
                                    (("integral_W_per_m=1",), 2, "did you mean integral_W_per_m_s"),
                                    (("kind=mrack",), 2, "kind = mrack: did you mean mrac?"),
                                    (("shape_reference=1",), 2, "there are: false, true"),
                                    (("adaptation_scale=0",), 2, "adaptation_scale = 0: must be 1e-06 to 1e+06"),
                                    (("adaptation_scale",), 2, "write NAME=VALUE"),
                                    (("follow_s=1",), 1, "mrac has no follow_s; it has kind, shape_reference, "),
                                    (("kind=pi", "gain_1=5"), 1, "pi has no gain_1; it has kind, proportional_W_per_m, "),
                                    (("kind=pi", "integral_W_per_m_s=1e7"), 1, "refused: unsuitable: unstable on the muscle"),
                                    (("--controller", "2", "kind=pi"), 2, "there is no controller 2; there is 0 (mrac)"),
                                    (("--controller", "2"), 2, "there is no controller 2; there is 0 (mrac)"),
                                    (("--controller", "pi"), 2, "there is no controller pi; there is 0 (mrac)"),
                                    (("--estimator", "0", "bandwidth_rad_per_s=1"), 2, "bandwidth_rad_per_s cannot be tuned; there are: kind, "),
                                    (("--estimator", "0", "kind=pi"), 2, "there are: none, gradient, least_squares"),
                                    (("--estimator", "2", "kind=none"), 2, "there is no estimator 2; there is 0 (gradient)"),
                                    (("--estimator", "0", "--controller", "0"), 2, "--controller excludes --estimator")):
            done = self.tune(*words)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(expected, done.stderr)
        for words, expected in ((("tune", "5"), "1 tune 5: there is no controller 5; there is 0 (mrac)"),
                            (("tune", "9"), "1 tune 9: there is no estimator 1; there is 0 (gradient)"),
                            (("controller", "pi"), "1 controller pi: there is no controller pi; there is 0 (mrac)"),
                            (("estimator", "none"), "1 estimator none: there is no estimator none; there is 0 (gradient)")):
            done = command(self.source, "1", *words)
            self.assertEqual((done.returncode, done.stderr), (2, f"supercoil: {expected}\n"))
        self.assertIn("'x': must be state, or a node, as in '1 arm'", command(self.source, "x", "tune", "0").stderr)
        self.assertEqual(self.values()["kind"]["in_use"], "mrac")
        self.assertIn("no answer from node 2", self.tune(channel="2").stderr)


class TuningPage(PageCase):
    def opened(self):
        page = self.page()
        page.click(f"{CARD} summary")

        def read():
            if "no answer" in page.text(f"{CARD} .answer"):  # of a board that was starved: a person asks again
                page.click(f"{CARD} summary")
            if page.run(f"return !document.querySelector(\"{CARD}\").open"):
                page.click(f"{CARD} summary")
            return "adaptation scale" in page.text(f"{CARD} tbody")
        page.wait(read, ANSWER_S, "the values are read")
        return page

    def row(self, page, name):
        return page.run(f"""const head = [...document.querySelectorAll("{CARD} tbody th")].find((th) => th.textContent.endsWith("{name}"));
            return head ? [head.textContent, ...[...head.parentElement.querySelectorAll("td.value")].map((td) => td.textContent)] : null""")

    def put(self, page, name, text):
        field = page.find(f"{CARD} [aria-label='new {name}']")
        if field.tag_name == "input":
            field.clear()
        field.send_keys(text)

    def press(self, page, button):
        page.run(f"""[...document.querySelectorAll("{CARD} button")].find((b) => b.textContent === "{button}").click()""")

    def wait_for_answer(self, page, text):
        page.wait(lambda: text in page.text(f"{CARD} .answer"), ANSWER_S, text)

    def test_a_value_is_used_stored_and_restored(self):
        page = self.opened()
        self.put(page, "adaptation scale", "2.5")
        self.press(page, "use")
        self.wait_for_answer(page, "adaptation_scale = 2.5: in use")
        self.assertEqual(self.row(page, "adaptation scale"), ["✱ adaptation scale", "2.50", "1.00", "1.00"])
        self.press(page, "store")
        self.wait_for_answer(page, "stored for the next start")
        self.assertEqual(self.row(page, "adaptation scale")[3], "2.50")
        self.press(page, "as board.toml")
        self.wait_for_answer(page, "as board.toml: in use")
        self.press(page, "forget stored")
        self.wait_for_answer(page, "the next start uses board.toml")
        self.assertEqual(self.row(page, "adaptation scale"), ["adaptation scale", "1.00", "1.00", "1.00"])
        self.assertEqual(page.errors(), [])

    def test_unsuitable_values_are_reported_and_change_nothing(self):
        page = self.opened()
        self.put(page, "reference model", "design")
        self.press(page, "use")
        self.wait_for_answer(page, "unsuitable")
        self.assertEqual(self.row(page, "reference model")[1], "wm16")
        self.put(page, "adaptation scale", "much")
        self.press(page, "use")
        page.wait(lambda: "must be" in page.text(f"{CARD} .answer"), ANSWER_S, "the range is told")

    def test_a_reference_model_can_have_its_own_poles(self):
        page = self.opened()
        self.put(page, "reference model", "design")
        self.put(page, "kind", "pi")
        self.press(page, "use")
        self.wait_for_answer(page, "in use")
        self.assertEqual(self.row(page, "model pole 1 rad per s")[1], "–")
        self.put(page, "reference model", "poles")
        self.press(page, "use")
        self.wait_for_answer(page, "reference_model = poles: in use")
        self.put(page, "model pole 1 rad per s", "3")
        self.press(page, "use")
        self.wait_for_answer(page, "model_pole_1_rad_per_s = 3: in use")
        self.assertEqual(self.row(page, "model pole 1 rad per s")[1], "3.00")
        self.press(page, "as board.toml")
        self.wait_for_answer(page, "as board.toml: in use")

    def test_the_state_names_the_current_controller(self):
        page = self.page()
        for kind, verb in (("mrac", None), ("pi", "arm"), ("mrac", "disarm")):
            if verb is not None:
                tuned = subprocess.run([SUPERCOIL, "tune", "1", f"kind={kind}", "--can", self.source], capture_output=True, text=True)
                self.assertEqual(tuned.returncode, 0, tuned.stderr)
                self.assertEqual(command(self.source, "1", verb).returncode, 0)
            page.wait(lambda: kind in page.text(".state dl").split(), ANSWER_S, f"{kind} is named")

    def test_an_estimator_is_changed(self):
        page = self.opened()
        page.run(f"""[...document.querySelectorAll("{CARD} button")].find((b) => b.textContent === "estimator 0: gradient").click()""")
        self.put(page, "trusted error", "0.1")
        self.press(page, "use")
        self.wait_for_answer(page, "estimator 0: trusted_error = 0.1: in use")
        self.assertEqual(self.row(page, "trusted error")[:2], ["✱ trusted error", "0.100"])
        self.press(page, "as board.toml")
        self.wait_for_answer(page, "as board.toml: in use")
        self.assertEqual(page.errors(), [])

    def test_tuning_does_not_interrupt_tracking(self):
        page = self.opened()
        page.run("scrollTo(0, 0)")
        page.bring_to(TARGET_MM)
        self.put(page, "kind", "pi")
        self.press(page, "use")
        self.wait_for_answer(page, "kind = pi: in use")
        self.assertIsNotNone(self.row(page, "integral W per m s"))
        self.assertEqual(page.state(), "active")
        self.assertLess(abs(page.value("position") - TARGET_MM), 2 * NEAR_MM)
        page.press_space()
        self.press(page, "as board.toml")
        self.wait_for_answer(page, "as board.toml: in use")


if __name__ == "__main__":
    unittest.main()
