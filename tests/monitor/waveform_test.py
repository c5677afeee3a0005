"""Waveforms that the page plays to a muscle: what they are, and that they end as anything that heats does.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, else those of build/release.
"""

import pathlib
import time
import unittest

from modules import ModulesCase
from page_test import Page, PageCase, READY_S, STOP_S
from programs import SLACK_S
from selenium.webdriver.common.action_chains import ActionChains

CARD = "details[aria-label='waveform for node 1']"
SHAPES = 'const { waveform, refuse_values, waveform_of_file } = await import("/waveform.js");'


class Shapes(ModulesCase):
    def test_sine_steps_and_chirp_are_about_their_offset(self):
        sine, steps, chirp, end_s = self.ask(SHAPES + """const values = { offset: 8, amplitude: 2, period: 10, last_period: 2, duration: 60 };
            const at = (shape, times) => times.map((time) => Number((1e3 * waveform(shape, values).at(time)).toFixed(3)));
            // A chirp's phase at its end is the mean of both frequencies times its duration: 18 periods here.
            return [at("sine", [0, 2.5, 7.5, 10]), at("steps", [0, 4.9, 5.1, 10.1]), at("chirp", [0, 60]), waveform("chirp", values).end_s];""")
        self.assertEqual(sine, [8, 10, 6, 8])
        self.assertEqual(steps, [10, 10, 6, 10])
        self.assertEqual(chirp, [8, 8])
        self.assertEqual(end_s, 60)

    def test_a_chirp_ends_with_its_last_period(self):
        self.assertAlmostEqual(self.ask(SHAPES + """const { at } = waveform("chirp", { offset: 8, amplitude: 2, period: 10, last_period: 2, duration: 60 });
            let crossings = 0; // upwards, in the last four seconds
            for (let time = 56; time < 60; time += 0.001) if (at(time) < 0.008 && at(time + 0.001) >= 0.008) ++crossings;
            return crossings;"""), 2)

    def test_what_leaves_the_travel_is_refused_with_what_is_allowed(self):
        told = self.ask(SHAPES + """const values = { offset: 8, amplitude: 2, period: 10, last_period: 2, duration: 60 };
            const why = (changed, shape = "sine") => refuse_values(shape, { ...values, ...changed }, 0.0201);
            return [why({}), why({ offset: 1 }), why({ offset: 19, amplitude: -2 }), why({ period: 0 }), why({ amplitude: NaN }),
                why({ last_period: -1 }, "chirp"), why({ last_period: -1 })];""")
        self.assertEqual(told, ["", "offset and amplitude reach from -1.00 to 3.00 mm; allowed: 0 to 20.10 mm",
                                "offset and amplitude reach from 17.00 to 21.00 mm; allowed: 0 to 20.10 mm", "period must be more than 0",
                                "amplitude: a number is missing", "last period must be more than 0", ""])

    def test_a_file_is_straight_between_its_rows(self):
        self.assertEqual(self.ask(SHAPES + """const { at, end_s } = waveform_of_file("\\uFEFFnote,time_s,position_m\\r\\na,5,0.001\\nb,6,0.003\\n\\n,9,0\\n", 0.02);
            return [end_s, ...[0, 0.5, 1, 2.5, 4, 9].map((time) => Number((1e3 * at(time)).toFixed(6)))];"""), [4, 1, 2, 3, 1.5, 0, 0])

    def test_a_bad_file_is_told_by_line_value_and_range(self):
        told = self.ask(SHAPES + """const head = "time_s,position_m\\n";
            const why = (text) => { try { waveform_of_file(text, 0.02); return ""; } catch ({ message }) { return message; } };
            return [why("t,x\\n0,0\\n"), why(head + "0,0\\n1,0.025\\n"), why(head + "0,0\\n1,-0.001\\n"), why(head + "0,0\\n1,a\\n"), why(head + "0,0\\n1\\n"),
                why(head + "0,0\\n\\n0,0.001\\n"), why(head + "0,0\\n")];""")
        self.assertEqual(told, ['line 1: "t,x": the first line must name the columns time_s and position_m',
                                "line 3: position_m 0.025; allowed: 0 to 0.02 m", "line 3: position_m -0.001; allowed: 0 to 0.02 m",
                                'line 3: position_m is "a": a number is needed', 'line 3: position_m is "": a number is needed',
                                "line 4: time_s 0 is not later than 0 before it", "line 3: two rows at least are needed"])


class OnThePage(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shared = cls.enterClassContext(Page())

    def opened(self):
        page = self.shared
        page.driver.get("about:blank")  # else only what stands behind the # of the address would change
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
        """As often as the machine lets a command expire, again."""
        for _ in range(3):
            page.arm()
            self.start(page, **values)
            page.wait(lambda: page.state() != "armed", SLACK_S, "it plays")
            if page.state() == "active":
                return
        raise AssertionError("is not active after three tries")

    def references(self, page, count):
        """So many different ones, as the board tells them."""
        seen = set()
        page.wait(lambda: seen.add(page.value("reference")) or len(seen) >= count, SLACK_S, f"{count} references")
        return seen

    def commands(self, page):
        """So many the page has sent. The browser keeps the newest 250 requests unless it is told otherwise."""
        return page.run("return performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('/api/command')).length")

    def test_a_sine_moves_the_reference_until_it_is_stopped(self):
        page = self.opened()
        self.play(page, offset=6, amplitude=3, period=4)
        for reference in self.references(page, 12):
            self.assertTrue(2.99 <= reference <= 9.01, reference)
        page.click(f"{CARD} .buttons button[type=button]")
        page.wait(lambda: "the last set point holds" in page.text(f"{CARD} .answer"), SLACK_S, "stopped")
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
        self.play(page, offset=6, amplitude=3, period=4)
        page.run("document.activeElement.blur(); document.querySelector('.manual .value input').value = '8'")
        ActionChains(page.driver).send_keys("k").perform()
        page.wait(lambda: "commanded by hand" in page.text(f"{CARD} .answer"), SLACK_S, "ended")
        page.wait(lambda: abs(page.value("reference") - 8.1) < 1e-3, SLACK_S, "a step up from 8 mm")
        time.sleep(0.3)
        self.assertAlmostEqual(page.value("reference"), 8.1, 3)
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")

    def test_stop_ends_it_at_once_and_it_stays_ended(self):
        page = self.opened()
        page.run("performance.setResourceTimingBufferSize(100000)")
        self.play(page, offset=6, amplitude=3, period=4)
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")
        self.assertIn("the muscle was let go", page.text(f"{CARD} .answer"))
        sent = self.commands(page)
        self.assertGreater(sent, 0)
        page.click(".arm") if page.state() == "disarmed" else None
        page.wait(lambda: page.state() == "armed", READY_S, "armed again")
        time.sleep(0.5)
        self.assertEqual((page.state(), self.commands(page)), ("armed", sent + 1))

    def test_a_page_that_is_closed_lets_it_expire(self):
        page = self.opened()
        page.driver.switch_to.new_window("tab")
        page.open(self.address)
        watching, playing = reversed(page.driver.window_handles)
        page.driver.switch_to.window(playing)
        self.play(page, offset=6, amplitude=3, period=4)
        page.driver.close()
        page.driver.switch_to.window(watching)
        page.wait(lambda: page.state() == "fault" and "command timeout" in page.text(".state .fault"), SLACK_S, "expired")

    def test_a_file_is_played_and_a_bad_one_is_told(self):
        page = self.opened()
        page.run(f"""document.querySelector("{CARD} [value=file]").click()""")
        file = pathlib.Path(page.profile.name) / "motion.csv"
        file.write_text("time_s,position_m\n0,0.004\n1,5\n")
        page.find(f"{CARD} [type=file]").send_keys(str(file))
        self.start(page)
        page.wait(lambda: "line 3: position_m 5; allowed: 0 to 0.03996 m" in page.text(f"{CARD} .answer"), SLACK_S, "the bad line")
        file.write_text("time_s,position_m\n0,0.004\n1,0.006\n2,0.005\n")
        page.find(f"{CARD} [type=file]").send_keys(str(file))
        self.play(page)
        page.wait(lambda: "played to its end" in page.text(f"{CARD} .answer"), SLACK_S, "the end")
        page.wait(lambda: page.value("reference") == 5.0, SLACK_S, "its last position")
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")


if __name__ == "__main__":
    unittest.main()
