"""The live page in a real browser, over a simulated board that runs in real time: arms, moves and stops the muscle.

    page_test.py                the tests
    page_test.py --pictures     takes the pictures of docs/monitor.md instead
Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import pathlib
import sys
import tempfile
import time
import unittest
import urllib.parse

from browser import Browser
from programs import OnSimulatedBoard, ROOT, log_of, monitor, simulated_board, with_second_node
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

PICTURES = ROOT / "docs" / "pictures"
# The page promises a second; the machine of a test does other work.
FIRST_PLOT_S = 20.0
STOP_S = 1.0
# A board waits until its muscle must have cooled before it can be armed.
READY_S = 60.0
ARRIVES_S = 20.0
IDENTIFIES_S = 200.0
TRIES = 3
TARGET_MM = 8.0
NEAR_MM = 0.5


def number(text):
    return float(text.split()[0].replace("−", "-"))


class Page(Browser):
    """The monitor's page, by what a person sees of it."""

    def open(self, address):
        self.driver.get(address)
        self.wait(lambda: self.run("return performance.getEntriesByName('first-plot').length") > 0, FIRST_PLOT_S,
                  "a plot is drawn")

    def wait(self, condition, patience_s, what):
        end_s = time.monotonic() + patience_s
        while not condition():
            if time.monotonic() > end_s:
                raise AssertionError(f"{what}: not within {patience_s} s; the page says: {self.text('body')[:600]}")
            time.sleep(0.05)

    def state(self):
        return self.text(".state .word")

    def value(self, name):
        return number(self.run(f"""return [...document.querySelectorAll('.readouts dt')]
            .find((dt) => dt.textContent === '{name}').nextSibling.textContent"""))

    def arm(self):
        """Arms from any state."""
        def armed():
            state = self.state()
            if state in ("disarmed", "fault"):
                self.click(".arm" if state == "disarmed" else ".reset")
                time.sleep(0.4)
            return state in ("armed", "active")
        self.wait(armed, READY_S, "armed")

    def move(self, position_mm):
        self.click("input[value=position] + span")
        field = self.find(".value input")
        field.clear()
        field.send_keys(str(position_mm), Keys.ENTER)
        self.wait(self.has_begun, 10.0, "active")

    def has_begun(self):
        """Whether the muscle is active, or was: when the machine stalls, the command may expire before anybody looks."""
        return self.state() in ("active", "fault")

    def arrive(self, position_mm):
        self.wait(lambda: self.state() != "active" or abs(self.value("position") - position_mm) < NEAR_MM, ARRIVES_S,
                  f"at {position_mm} mm")
        return self.state() == "active"

    def bring_to(self, position_mm):
        """Arms and moves. Repeats when the machine stalls for 0.25 s: then the command expires, as it must."""
        for _ in range(TRIES):
            self.arm()
            self.move(position_mm)
            if self.arrive(position_mm):
                return
            print(f"became {self.state()} under way: {self.text('.state .fault')}")
        raise AssertionError(f"did not arrive in {TRIES} tries")

    def identify(self):
        """Identifies the muscle; tries as often as bring_to()."""
        for _ in range(TRIES):
            self.arm()
            self.click("input[value=identify] + span")
            self.click(".go")
            self.wait(self.has_begun, 10.0, "identifies")
            self.wait(lambda: self.state() != "active", IDENTIFIES_S, "has identified")
            if self.state() == "armed":
                return
        raise AssertionError(f"did not identify in {TRIES} tries")

    def stop_by(self, act, patience_s=STOP_S):
        """Moves, then stops; returns how long that took. Tries again as bring_to() does."""
        for _ in range(TRIES):
            self.arm()
            self.move(TARGET_MM)
            if self.state() != "active":
                continue
            self.run("document.querySelector('#stop-notice').textContent = ''")  # an earlier STOP confirms nothing
            begin_s = time.monotonic()
            act()
            self.wait(lambda: self.state() != "active" and self.value("power") == 0.0, patience_s, "off")
            if self.state() == "disarmed":
                return time.monotonic() - begin_s
            print(f"became {self.state()} meanwhile: {self.text('.state .fault')}")
        raise AssertionError(f"was not stopped in {TRIES} tries")

    def stop_is_confirmed(self):
        """Whether STOP is confirmed, by its own port, or by the other ways when this machine is busy for half a second or two."""
        return self.text("#stop-notice").startswith(
            ("stopped node", "disarmed each node by a command", "every node reports its muscle off"))

    def stop_port(self):
        return self.run("return fetch('/api/about').then((answer) => answer.json())")["stop_port"]

    def press_space(self):
        ActionChains(self.driver).send_keys(" ").perform()

    def is_off(self):
        return self.state() == "disarmed" and self.value("power") == 0.0


class PageCase(OnSimulatedBoard):
    """A board, a monitor over it, pages of it."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.monitor = monitor(cls.source)
        cls.addClassCleanup(cls.monitor.stop)
        cls.address = cls.monitor.found[0]
        cls.origin = cls.monitor.found[1]

    def page(self, address=None, **size):
        page = self.enterContext(Page(**size))
        page.open(address or self.address)
        return page


class PageTest(PageCase):
    def test_the_first_plot_appears_quickly(self):
        page = self.page()
        first_s = page.run("return performance.getEntriesByName('first-plot')[0].startTime") / 1e3
        print(f"first plot after {first_s:.2f} s")
        self.assertLess(first_s, FIRST_PLOT_S)
        self.assertEqual(page.text("#status b"), "live")
        self.assertEqual(page.errors(), [])

    def test_every_module_is_preloaded(self):
        page = self.page()
        loaded = {urllib.parse.urlparse(address).path for address in page.requests()
                  if address.startswith(self.origin) and address.endswith(".js")}
        named = set(page.run("return [...document.querySelectorAll('[rel=modulepreload], script')]"
                             ".map((e) => new URL(e.href ?? e.src).pathname)"))
        self.assertEqual(loaded - {"/stream_worker.js"}, named)

    def test_arm_set_point_and_space_work(self):
        page = self.page()
        page.bring_to(TARGET_MM)
        self.assertGreater(page.value("power"), 0.0)
        self.assertEqual(page.text(".state .foreign"), "", "board and page are of one version")
        # The focus is in the number's field: there, too, the space bar stops.
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")
        self.assertEqual(page.find(".value input").get_attribute("value"), str(TARGET_MM))
        page.wait(page.stop_is_confirmed, STOP_S, "stop is confirmed")

    def test_shows_how_identify_and_calibrate_ended(self):
        page = self.page()
        page.arm()
        # Identify, as it lasts longer than a busy machine takes to press a key; a cold muscle is calibrated in two seconds.
        page.click("input[value=identify] + span")
        page.click(".go")
        page.wait(lambda: "identify:" in page.text(".state .progress"), 5.0, "identifies")
        page.press_space()
        page.wait(lambda: "interrupted: it was disarmed" in page.text(".state"), 5.0, "told that it was stopped")
        page.arm()
        page.click("input[value=calibrate] + span")
        page.click(".go")
        page.wait(lambda: "found: used from now on, and stored" in page.text(".state"), READY_S, "told that it was found")

    def test_controller_gains_are_shown_by_name(self):
        page = self.page()
        gains = "section[aria-label='gains of the controller, node 1']"
        page.wait(lambda: len(page.text(f"{gains} tbody").splitlines()) == 7, READY_S, "all gains of MRAC")
        rows = dict(line.rsplit(" ", 1) for line in page.text(f"{gains} tbody").splitlines())
        self.assertEqual(list(rows), ["power rate", "power", "position rate", "position lag", "position", "reference",
                                      "sigma"])
        self.assertNotEqual(float(rows["reference"]), 0.0)

    def test_space_stops_without_pressing_the_focused_button(self):
        page = self.page()
        page.arm()
        page.run("document.querySelector('#keys').focus()")
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")
        self.assertFalse(page.find("#help").is_displayed())

    def test_clicking_stop_disarms(self):
        page = self.page()
        page.stop_by(lambda: page.click("#stop"))

    def test_refusal_is_shown_in_words(self):
        page = self.page()
        page.click(".disarm")
        page.wait(lambda: page.state() == "disarmed", READY_S, "disarmed")
        page.click(".go")
        page.wait(lambda: "refused: wrong state: arm it first, or reset its fault" in page.text(".answer"), 2.0, "refusal")

    def test_without_a_token_it_is_read_only(self):
        page = self.page(self.origin)
        self.assertIn("no token", page.text(".why"))
        self.assertFalse(page.find(".arm").is_enabled())
        page.wait(lambda: page.state() != "silent", 10.0, "a state")

    def test_token_does_not_stay_in_the_address_bar(self):
        page = self.page()
        self.assertNotIn("token", page.driver.current_url)
        page.driver.refresh()
        page.wait(lambda: page.text(".state .word") != "", FIRST_PLOT_S, "the page again")
        self.assertTrue(page.find(".arm").is_enabled())

    def test_a_hanging_page_lets_the_command_expire(self):
        page = self.page()
        page.arm()
        page.move(TARGET_MM)
        # A page that hangs, like one that sleeps, says nothing for longer than the monitor waits.
        page.run("const end_ms = performance.now() + 3500; while (performance.now() < end_ms);")
        page.wait(lambda: "command expired" in page.text(".notice"), 10.0, "the page says that it was away")
        page.wait(lambda: page.state() != "active", 2.0, "not active")

    def test_eight_open_pages_do_not_delay_stop(self):
        page = self.page()
        for _ in range(7):
            page.driver.switch_to.new_window("tab")
            page.open(self.address)
        print(f"eight pages: off {page.stop_by(page.press_space):.2f} s after the space bar")
        page.wait(page.stop_is_confirmed, STOP_S, "stop is confirmed")

    def test_page_requests_nothing_from_other_hosts(self):
        page = self.page()
        page.click("#stop")
        time.sleep(1.0)
        port = urllib.parse.urlparse(self.origin).port
        hosts = {urllib.parse.urlparse(address).netloc for address in page.requests()
                 if not address.startswith(("data:", "blob:", "chrome"))}
        self.assertLessEqual(hosts, {f"127.0.0.1:{port}", f"127.0.0.1:{port + 1}"})

    def test_on_a_phone_it_scrolls_vertically_and_shows_stop(self):
        page = self.page()
        page.screen(360, 740, mobile=True)
        page.wait(lambda: page.run("return document.documentElement.scrollWidth <= 360"), 2.0, "as wide as the phone")
        self.assertTrue(page.run("""const stop = document.getElementById('stop').getBoundingClientRect();
            return stop.left >= 0 && stop.right <= 360 && stop.top >= 0 && stop.bottom <= innerHeight"""))

    def test_pause_freezes_the_plots_only(self):
        page = self.page()
        ActionChains(page.driver).send_keys("p").perform()
        page.wait(lambda: page.text("#status b") == "paused", 1.0, "paused")
        before = page.text("#status span")
        page.wait(lambda: page.text(".state .word") not in ("", "silent"), 2.0, "the state stays live")
        self.assertEqual(page.text("#status span"), before)
        ActionChains(page.driver).send_keys("l").perform()
        page.wait(lambda: page.text("#status b") == "live", 1.0, "live")

    def test_csv_contains_the_visible_range(self):
        page = self.page()
        folder = pathlib.Path(page.profile.name) / "downloads"
        page.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
        page.click("input[value='10'] + span")
        page.click("#csv")
        page.wait(lambda: list(folder.glob("*.csv")), 5.0, "a file")
        head, *rows = next(folder.glob("*.csv")).read_text().splitlines()
        columns = head.split(",")
        self.assertEqual(columns[:2], ["time_s", "node"])
        position = columns.index("Measurement.position_m")
        measured = [row.split(",") for row in rows if row.split(",")[position]]
        self.assertGreater(len(measured), 100)
        times_s = [float(row.split(",")[0]) for row in rows]
        self.assertEqual(times_s, sorted(times_s))
        self.assertLessEqual(times_s[-1] - times_s[0], 10.0)
        self.assertIn("disarmed", {row.split(",")[columns.index("Status.state")] for row in rows})

    def test_a_lost_source_is_shown(self):
        board = simulated_board()
        self.addCleanup(board.stop)
        own = monitor(f"socketcand:{board.found[1]}")
        self.addCleanup(own.stop)
        page = self.page(own.found[0])
        page.wait(lambda: page.state() != "silent", 10.0, "a state")
        board.stop()
        page.wait(lambda: page.text("#status b") == "source lost", 10.0, "source lost")
        page.wait(lambda: page.state() == "silent", 10.0, "silent")
        own.stop()
        page.wait(lambda: page.text("#status b") == "connection lost", 10.0, "connection lost")
        page.press_space()
        page.wait(lambda: page.text("#stop-notice").startswith("STOP FAILED"), 10.0, "that STOP failed")

    def test_a_read_only_monitor_accepts_no_commands(self):
        own = monitor(f"socketcand:{self.board.found[1]}", "--read-only")
        self.addCleanup(own.stop)
        page = self.page(own.found[0])
        self.assertIn("--read-only", page.text(".why"))
        self.assertFalse(page.find(".arm").is_enabled())
        self.assertFalse(page.find("#stop").is_enabled())

    def test_log_is_replayed(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        own = monitor(log_of("first-motion", folder))
        self.addCleanup(own.stop)
        page = self.page(own.found[0])
        page.wait(lambda: page.text("#status b") == "log", 2.0, "a log")
        self.assertFalse(page.find("#stop").is_displayed())
        page.run("""const slider = document.querySelector('#replay input');
            slider.value = 205; slider.dispatchEvent(new Event('input'))""")
        page.wait(lambda: page.state() == "fault" and "heater open" in page.text(".state .fault"), 2.0, "the fault at 200 s")
        page.click("#replay button")
        page.wait(lambda: number(page.text("#replay output")) > 206.0, 5.0, "it plays")
        self.assertLess(number(page.text("#replay output")), 210.0)

    def test_two_nodes_have_tabs_and_a_common_one(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        own = monitor(with_second_node(log_of("first-motion", folder), lag_s=60.0))
        self.addCleanup(own.stop)
        page = self.page(own.found[0])
        page.wait(lambda: len(page.text("#tabs").splitlines()) == 3, 5.0, "a tab each, and one for both")
        page.run("""const slider = document.querySelector('#replay input');
            slider.value = 205; slider.dispatchEvent(new Event('input'))""")
        page.wait(lambda: page.text("#tabs").splitlines() == ["node 1 fault", "node 2 active", "side by side"], 5.0,
                  "each has the state of its own at 205 s")
        shown = ".node:not([hidden]) .state h2"
        titles = lambda: [title.text for title in page.driver.find_elements("css selector", shown)]  # noqa: E731
        self.assertEqual(titles(), ["Node 1"])
        page.find("#tabs [aria-selected=true]").send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(titles(), ["Node 2"])
        page.click("#tabs [role=tab]:last-child")
        self.assertEqual(titles(), ["Node 1", "Node 2"])

    def test_a_fault_links_to_its_page(self):
        page = self.page()
        page.click("#stop")
        page.wait(lambda: page.driver.find_elements("css selector", ".margins .link"), 5.0, "margins")
        page.wait(lambda: "over temperature" in page.text(".margins"), 5.0, "all detectors")
        page.run("[...document.querySelectorAll('.margins .link')].find((b) => b.textContent === 'over temperature').click()")
        page.wait(lambda: "30 over_temperature" in page.text("#fault-page article"), 2.0, "the fault's page")
        # It covers neither the button nor the key.
        page.press_space()
        page.wait(page.stop_is_confirmed, STOP_S, "stop is confirmed")


class Pictures(PageCase):
    """Pictures of a muscle that has something to show; a test run does not find them."""

    def runTest(self):
        page = self.page()
        page.screen(1440, 1390)
        page.identify()
        for position_mm in (8.0, 14.0, 5.0, 10.0):
            page.bring_to(position_mm)
            time.sleep(8.0)
        page.run("document.activeElement.blur()")
        for scheme in ("light", "dark"):
            page.colours(scheme)
            time.sleep(0.6)
            page.driver.save_screenshot(str(PICTURES / f"monitor-{scheme}.png"))
        page.colours("light")
        page.screen(390, 844, mobile=True)
        time.sleep(1.0)
        page.driver.save_screenshot(str(PICTURES / "monitor-phone.png"))
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")


if __name__ == "__main__":
    wanted = Pictures if "--pictures" in sys.argv else PageTest
    arguments = [word for word in sys.argv if word != "--pictures"]
    unittest.main(argv=arguments, verbosity=2, defaultTest=wanted.__name__)
