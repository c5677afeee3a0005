"""Waveforms that the page plays to a muscle: what they are, and that they end as everything that heats does.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import pathlib
import re
import time
import unittest

from modules import ModulesCase
from page_test import Page, PageCase, READY_S, STOP_S
from programs import SLACK_S
from selenium.webdriver.common.action_chains import ActionChains

CARD = "details[aria-label='waveform for node 1']"
# Of the bench's muscle: to its first point, and as much as it can follow.
ARRIVES_S = 45.0
SINE = {"offset": 6, "amplitude": 1, "period": 4}
SHAPES = 'const { waveform, refuse_values, waveform_of_file } = await import("/waveform.js");'


class Shapes(ModulesCase):
    def test_sine_steps_and_chirp_are_centred_on_their_offset(self):
        sine, steps, chirp, end_s = self.run_script(SHAPES + """const values = { offset: 8, amplitude: 2, period: 10, last_period: 2, duration: 60 };
            const at = (shape, times) => times.map((time) => Number((1e3 * waveform(shape, values).at(time)).toFixed(3)));
            // A chirp's phase at its end is the mean of both frequencies times its duration: 18 periods here.
            return [at("sine", [0, 2.5, 7.5, 10]), at("steps", [0, 4.9, 5.1, 10.1]), at("chirp", [0, 60]), waveform("chirp", values).end_s];""")
        self.assertEqual(sine, [8, 10, 6, 8])
        self.assertEqual(steps, [10, 10, 6, 10])
        self.assertEqual(chirp, [8, 8])
        self.assertEqual(end_s, 60)

    def test_a_chirp_ends_with_its_last_period(self):
        self.assertAlmostEqual(self.run_script(SHAPES + """const { at } = waveform("chirp", { offset: 8, amplitude: 2, period: 10, last_period: 2, duration: 60 });
            let crossings = 0; // upwards, in the last four seconds
            for (let time = 56; time < 60; time += 0.001) if (at(time) < 0.008 && at(time + 0.001) >= 0.008) ++crossings;
            return crossings;"""), 2)

    def test_values_beyond_the_travel_are_refused_with_the_range(self):
        errors = self.run_script(SHAPES + """const values = { offset: 8, amplitude: 2, period: 10, last_period: 2, duration: 60 };
            const why = (changed, shape = "sine") => refuse_values(shape, { ...values, ...changed }, 0.0201);
            return [why({}), why({ offset: 1 }), why({ offset: 19, amplitude: -2 }), why({ period: 0 }), why({ amplitude: NaN }),
                why({ last_period: -1 }, "chirp"), why({ last_period: -1 })];""")
        self.assertEqual(errors, ["", "offset and amplitude reach from -1.00 to 3.00 mm; allowed: 0 to 20.10 mm",
                                "offset and amplitude reach from 17.00 to 21.00 mm; allowed: 0 to 20.10 mm", "period must be more than 0",
                                "amplitude: a number is missing", "last period must be more than 0", ""])

    def test_a_file_is_interpolated_linearly(self):
        self.assertEqual(self.run_script(SHAPES + """const { at, end_s } = waveform_of_file("\\uFEFFnote,time_s,position_m\\r\\na,5,0.001\\nb,6,0.003\\n\\n,9,0\\n", 0.02);
            return [end_s, ...[0, 0.5, 1, 2.5, 4, 9].map((time) => Number((1e3 * at(time)).toFixed(6)))];"""), [4, 1, 2, 3, 1.5, 0, 0])

    def test_a_bad_file_is_reported_by_line_value_and_range(self):
        errors = self.run_script(SHAPES + """const head = "time_s,position_m\\n";
            const why = (text) => { try { waveform_of_file(text, 0.02); return ""; } catch ({ message }) { return message; } };
            return [why("t,x\\n0,0\\n"), why(head + "0,0\\n1,0.025\\n"), why(head + "0,0\\n1,-0.001\\n"), why(head + "0,0\\n1,a\\n"), why(head + "0,0\\n1\\n"),
                why(head + "0,0\\n\\n0,0.001\\n"), why(head + "0,0\\n")];""")
        self.assertEqual(errors, ['line 1: "t,x": the first line must name the columns time_s and position_m',
                                "line 3: position_m 0.025; allowed: 0 to 0.02 m", "line 3: position_m -0.001; allowed: 0 to 0.02 m",
                                'line 3: position_m is "a": a number is needed', 'line 3: position_m is "": a number is needed',
                                "line 4: time_s 0 is not later than 0 before it", "line 3: at least two rows are needed"])


class Trajectories(ModulesCase):
    SCRIPT = """const { jumps, swinging, through } = await import("/trajectory.js");
        const values = { offset: 8, amplitude: 2, period: 10, last_period: 2, duration: 60 };
        const first = (motion, count) => { const knots = motion.knots(); return Array.from({ length: count }, () => knots.next().value); };
        const all = (motion) => [...motion.knots()].map(({ time_s, position_m, velocity_m_per_s }) => [time_s, position_m, velocity_m_per_s]);
        """

    def test_a_sine_starts_at_rest_with_consistent_velocities(self):
        knots = self.run_script(self.SCRIPT + """return first(swinging("sine", values), 1000);""")
        self.assertEqual(list(knots[0].values()), [0, 0.008, 0])
        self.assertLess(abs(knots[1]["position_m"] - 0.008), 1e-9)
        for before, knot, after in zip(knots, knots[1:], knots[2:]):
            self.assertAlmostEqual(knot["time_s"] - before["time_s"], 0.04, 6)
            self.assertAlmostEqual(knot["velocity_m_per_s"], (after["position_m"] - before["position_m"]) / 0.08, 5)
        late = [knot["position_m"] for knot in knots if knot["time_s"] > 10]
        self.assertAlmostEqual(max(late), 0.01, 5)
        self.assertAlmostEqual(min(late), 0.006, 5)

    def test_a_chirp_ends_at_rest_at_its_offset(self):
        knots = self.run_script(self.SCRIPT + """return all(swinging("chirp", { ...values, last_period: 0.3, duration: 30.03 }));""")
        self.assertEqual((knots[0], knots[-1]), ([0, 0.008, 0], [30.03, 0.008, 0]))
        steps = [after[0] - before[0] for before, after in zip(knots, knots[1:])]
        self.assertAlmostEqual(steps[0], 0.02, 6)
        self.assertTrue(all(0.009 < step < 0.031 for step in steps), (min(steps), max(steps)))

    def test_jumps_and_fast_periods_are_not_trajectories(self):
        self.assertEqual(self.run_script(self.SCRIPT + """return [jumps("sine", values), jumps("steps", values), jumps("sine", { ...values, last_period: 0.1 }),
            jumps("chirp", { ...values, last_period: 0.1 }), jumps("sine", { ...values, period: 0.19 })];"""),
            ["", "it jumps", "", *["a period of less than 0.2 s has too few knots"] * 2])

    def test_a_file_is_smoothed_and_close_rows_are_thinned(self):
        rows, thinned, apart, short = self.run_script(self.SCRIPT + """const rounded = (motion) => all(motion).map((knot) => knot.map((value) => Number(value.toFixed(6))));
            return [rounded(through([[5, 0.001], [6, 0.003], [8, 0.004]])), rounded(through([[0, 0], [0.005, 0.1], [0.02, 0.001], [0.03, 0.002], [0.045, 0.003]])),
                through([[0, 0], [5, 0.001]]).why, through([[0, 0], [0.01, 0.001]]).why];""")
        self.assertEqual(rows, [[0, 0.001, 0], [1, 0.003, 0.0015], [3, 0.004, 0]])  # (2 mm/s · 2 s + 0.5 mm/s · 1 s) / 3 s
        self.assertEqual(thinned, [[0, 0, 0], [0.02, 0.001, 0.063333], [0.045, 0.003, 0]])
        self.assertEqual((apart, short), ("rows are more than 4.094 s apart", "it lasts less than 0.02 s"))


class WaveformPage(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shared = cls.enterClassContext(Page())

    def opened(self):
        page = self.shared
        page.driver.get("about:blank")  # otherwise only the part after the # of the address would change
        page.open(self.address)
        page.click(f"{CARD} summary")
        page.wait(lambda: page.find(".manual .value input").get_attribute("max") == "39.96", SLACK_S, "the bench's travel is told")
        return page

    def start(self, page, **values):
        for name, value in values.items():
            field = page.find(f"#wave-{name}-1")
            field.clear()
            field.send_keys(str(value))
        page.click(f"{CARD} [type=submit]")

    def play(self, page, **values):
        """Repeats when the machine lets a command expire."""
        for _ in range(3):
            page.arm()
            self.start(page, **values)
            page.wait(lambda: page.state() != "armed", SLACK_S, "it plays")
            if page.state() == "active":
                return
        raise AssertionError("is not active after three tries")

    def answer(self, page):
        return page.text(f"{CARD} .answer")

    def play_ahead(self, page, until=r"ahead on the board", **values):
        """Plays a trajectory until the page says so; repeats as play() does."""
        for _ in range(3):
            self.play(page, **values)
            page.wait(lambda: re.search(until, self.answer(page)) or page.state() != "active", ARRIVES_S, until)
            if page.state() == "active":
                return
            print(f"became {page.state()} meanwhile: {self.answer(page)}; {page.text('.state .fault')}")
        raise AssertionError("is not played after three tries")

    def references(self, page):
        """References of the newest 2 s, in mm, as the board reports them every 10 ms."""
        return [1e3 * reference_m for reference_m in page.run("return fetch('/api/history?from_s=-2').then((answer) => answer.json())")["nodes"]["1"]["Tracking"]["reference_m"]]

    def requests(self, page):
        """How many commands and knots the page has sent. The browser keeps the newest 250 requests unless told otherwise."""
        return page.run("return performance.getEntriesByType('resource').filter(({ name }) => /command|trajectory/.test(name)).length")

    def stop(self, page):
        page.click(f"{CARD} .buttons button[type=button]")
        page.wait(lambda: "the last set point holds" in self.answer(page), SLACK_S, "stopped")

    def test_a_sine_moves_the_reference_until_stopped(self):
        page = self.opened()
        self.assertIn("As a trajectory", page.text(CARD))
        self.play_ahead(page, r"sine: [6-9]\.\d s, \d\.\d s ahead", **SINE)  # a period and a half
        smooth = self.references(page)
        self.stop(page)
        page.find(f"{CARD} .choice input").click()
        self.assertIn("As set points, 20 per second: it was chosen", page.text(CARD))
        self.start(page)
        page.wait(lambda: re.search(r"sine: [3-9]\.\d s", self.answer(page)), SLACK_S, "set points")
        steps = self.references(page)
        for reference in smooth + steps:
            self.assertTrue(4.99 <= reference <= 7.01, reference)
        largest = [max(abs(after - before) for before, after in zip(references, references[1:])) for references in (smooth, steps)]
        # 1 mm · 2π / 4 s in 10 ms, or in 50.
        self.assertLess(largest[0], 0.03)
        self.assertGreater(largest[1], 2 * largest[0])
        self.stop(page)
        time.sleep(0.3)
        held = page.value("reference")
        time.sleep(0.5)
        self.assertEqual((page.state(), page.value("reference")), ("active", held))
        # By the keyboard from there, a step at a time.
        page.run("document.activeElement.blur(); document.querySelector('.manual .value input').value = '6'")
        ActionChains(page.driver).send_keys("kkj").perform()
        page.wait(lambda: abs(page.value("reference") - 6.1) < 1e-3, SLACK_S, "two steps up and one down")
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")

    def test_a_command_by_hand_ends_it(self):
        page = self.opened()
        self.play_ahead(page, **SINE)
        page.run("document.activeElement.blur(); document.querySelector('.manual .value input').value = '8'")
        ActionChains(page.driver).send_keys("k").perform()
        page.wait(lambda: "commanded by hand" in self.answer(page), SLACK_S, "ended")
        page.wait(lambda: abs(page.value("reference") - 8.1) < 1e-3, SLACK_S, "a step up from 8 mm")
        time.sleep(0.3)
        self.assertAlmostEqual(page.value("reference"), 8.1, 3)
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")

    def test_stop_ends_it_for_good(self):
        page = self.opened()
        page.run("performance.setResourceTimingBufferSize(100000)")
        self.play_ahead(page, **SINE)
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")
        self.assertIn("the muscle was let go", self.answer(page))
        sent = self.requests(page)
        self.assertGreater(sent, 0)
        page.click(".arm") if page.state() == "disarmed" else None
        page.wait(lambda: page.state() == "armed", READY_S, "armed again")
        time.sleep(0.5)
        self.assertEqual((page.state(), self.requests(page)), ("armed", sent + 1))

    def test_an_infeasible_motion_is_refused_with_its_time(self):
        page = self.opened()
        self.play(page, offset=6, amplitude=3, period=1)
        page.wait(lambda: "sine: the motion up to" in self.answer(page), ARRIVES_S, "refused")
        self.assertRegex(self.answer(page), r"sine: the motion up to 0\.\d\d s is infeasible: it needs more power than there is, or faster cooling")
        self.assertEqual((page.state(), page.value("reference")), ("active", 6.0))
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")

    def test_choosing_another_shape_ends_playback(self):
        page = self.opened()
        self.play_ahead(page, **SINE)
        page.run(f"""document.querySelector("{CARD} [value=steps]").click()""")
        page.wait(lambda: "another shape or mode was chosen" in self.answer(page), SLACK_S, "ended")
        self.assertIn("As set points, 20 per second: it jumps", page.text(CARD))
        self.assertFalse(page.find(f"{CARD} .choice").is_displayed())
        time.sleep(0.3)
        held = page.value("reference")
        time.sleep(3.5)  # longer than the board had knots for, and would have held a way that ran dry
        self.assertEqual((page.state(), page.value("reference")), ("active", held))
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")

    def test_a_hidden_page_lets_the_muscle_rest(self):
        page = self.opened()
        page.run("performance.setResourceTimingBufferSize(100000)")
        self.play_ahead(page, **SINE)
        page.run("Object.defineProperty(document, 'hidden', { value: true }); document.dispatchEvent(new Event('visibilitychange'))")
        page.wait(lambda: "the page was hidden; the muscle rests" in self.answer(page), SLACK_S, "ended")
        page.wait(lambda: page.state() == "armed", SLACK_S, "it rests")
        sent = self.requests(page)
        time.sleep(0.5)
        self.assertEqual((page.state(), self.requests(page)), ("armed", sent))

    def test_a_closed_page_lets_the_command_expire(self):
        page = self.opened()
        page.driver.switch_to.new_window("tab")
        page.open(self.address)
        watching, playing = reversed(page.driver.window_handles)
        page.driver.switch_to.window(playing)
        self.play_ahead(page, **SINE)
        page.driver.close()
        page.driver.switch_to.window(watching)
        # It may still have been hidden, and have said so.
        page.wait(lambda: page.state() == "armed" or page.state() == "fault" and "command timeout" in page.text(".state .fault"), SLACK_S, "cold")

    def test_a_file_is_played_and_a_bad_one_reported(self):
        page = self.opened()
        page.run(f"""document.querySelector("{CARD} [value=file]").click()""")
        file = pathlib.Path(page.profile.name) / "motion.csv"
        file.write_text("time_s,position_m\n0,0.004\n1,5\n")
        page.find(f"{CARD} [type=file]").send_keys(str(file))
        self.start(page)
        page.wait(lambda: "line 3: position_m 5; allowed: 0 to 0.03996 m" in self.answer(page), SLACK_S, "the bad line")
        file.write_text("time_s,position_m\n0,0.004\n2,0.005\n4,0.006\n6,0.005\n")
        page.find(f"{CARD} [type=file]").send_keys(str(file))
        self.play(page)
        page.wait(lambda: "played to its end" in self.answer(page), ARRIVES_S, "the end")
        page.wait(lambda: page.value("reference") == 5.0, SLACK_S, "its last position")
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")


if __name__ == "__main__":
    unittest.main()
