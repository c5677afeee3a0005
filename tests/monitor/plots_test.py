"""The page's plots as the user wants them: chosen quantities, another run below, marks at events, pictures of them.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import pathlib
import tempfile
import unittest

from modules import ModulesCase
from page_test import Page
from programs import SLACK_S, log_of, monitor
from selenium.webdriver.common.action_chains import ActionChains

# What a plot has painted in a colour's place: the number of its pixels.
PAINTED = """const [title, rgb, least, most] = arguments; // alpha
    const canvas = document.querySelector(`figure[aria-label^="${title},"] canvas`);
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let painted = 0;
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] >= least && data[i + 3] <= most && rgb.every((value, c) => Math.abs(data[i + c] - value) <= 6)) ++painted;
    return painted;"""
MODEL_OF_POSITION = "#plots [aria-label=Position] label"


class CsvRun(ModulesCase):
    TOOLS = 'const { OtherRun, batch_of_csv, batch_of_store } = await import("/other_run.js"); const { csv } = await import("/csv.js");'

    def test_an_exported_csv_can_be_loaded_again(self):
        self.assertEqual(self.run_script(self.TOOLS + """const { protocol } = await (await fetch("/api/about")).json();
            const store = new Store(protocol, true);
            store.append({ newest_s: 3, nodes: { 2: { Measurement: { time_s: [1, 2, 3], position_m: [0.001, null, 0.003] }, Status: { time_s: [1.5], state: [2] } } } });
            const run = new OtherRun(protocol);
            run.take(batch_of_csv(await (await csv(store, [2], { from_s: 0, to_s: 9 })).text()), "a");
            const values = (table) => [...table.rows(0, 9)].map((row) => [row.time_s, Number.isNaN(row.position_m) ? null : Number(row.position_m.toFixed(6))]);
            const kept = new OtherRun(protocol);
            kept.take(batch_of_store(store, [2], { from_s: 1.5, to_s: 9 }), "b");
            kept.begin_at(101);
            // Another node's plots show it too: a run of one board under that of another.
            return [values(run.table(2, "Measurement")), values(run.table(7, "Measurement")), values(kept.table(2, "Measurement")), kept.later_s];"""),
            [[[1, 0.001], [3, 0.003]], [[1, 0.001], [3, 0.003]], [[2, None], [3, 0.003]], 99.5])

    def test_csv_times_keep_their_microseconds(self):
        self.assertEqual(self.run_script(self.TOOLS + """const { protocol } = await (await fetch("/api/about")).json();
            const store = new Store(protocol, true);
            store.append({ newest_s: 3, nodes: { 1: { Emergency: { time_s: [3], fault: [30], state: [3], board_time_s: [2592000.123457] } } } });
            return (await (await csv(store, [1], { from_s: 0, to_s: 9 })).text()).split("\\n")[1];"""),
            "3.000000,1,over_temperature,fault,2592000.123457")

    def test_an_invalid_csv_is_reported_by_line(self):
        errors = self.run_script(self.TOOLS + """const why = (text) => { try { batch_of_csv(text); return ""; } catch ({ message }) { return message; } };
            const head = "time_s,node,Measurement.position_m\\n";
            return [why("a,b\\n1,2\\n"), why(head + "1,1,0\\n0.5,1,0\\n"), why(head + "1,1\\n"), why(head), why(head + "1,1,0\\n")];""")
        for error, line in zip(errors, ("line 1: the columns", "line 3: 3 cells", "line 2: 3 cells", "line 1: there are no rows", "")):
            self.assertTrue(error.startswith(line) and bool(error) == bool(line), error)


class PlotsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.monitor = monitor(log_of("first-motion", folder))
        cls.addClassCleanup(cls.monitor.stop)
        cls.page = cls.enterClassContext(Page())

    def setUp(self):
        self.page.driver.get("about:blank")
        self.page.open(self.monitor.found[0])
        self.page.run("localStorage.clear()")
        self.page.driver.get("about:blank")
        self.page.open(self.monitor.found[0])
        self.folder = pathlib.Path(self.page.profile.name) / self.id()
        self.page.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(self.folder))

    def tearDown(self):
        self.assertEqual(self.page.errors(), [])

    def colour(self, name):
        hexadecimal = self.page.run(f"return getComputedStyle(document.documentElement).getPropertyValue('--{name}').trim()")
        return [int(hexadecimal[i:i + 2], 16) for i in (1, 3, 5)]

    def painted(self, title, rgb, least=1, most=255):
        return self.page.driver.execute_script(PAINTED, title, rgb, least, most)

    def titles(self):
        return self.page.run("return [...document.querySelectorAll('figure h3')].map((title) => title.firstChild.textContent.trim())")

    def press(self, button, place="#run"):
        self.page.run(f"[...document.querySelectorAll('{place} button')].find((b) => b.textContent === '{button}').click()")

    def file(self, pattern):
        self.page.wait(lambda: list(self.folder.glob(pattern)), SLACK_S, pattern)
        return next(self.folder.glob(pattern))

    def test_chosen_quantities_are_remembered(self):
        page = self.page
        page.click("#choose-plots")
        names = page.run(f"return [...document.querySelectorAll('{MODEL_OF_POSITION}')].map((label) => label.textContent.trim())")
        self.assertEqual(names, ["reference", "model", "position", "position less model"])
        page.run(f"document.querySelectorAll('{MODEL_OF_POSITION}')[1].click(); document.querySelectorAll('{MODEL_OF_POSITION}')[3].click();"
                 "document.querySelector('#plots [aria-label=Supply] label').click()")
        legend = "return [...document.querySelectorAll('figure[aria-label^=Position] .legend li')].map((li) => li.firstChild.textContent.trim())"
        for _ in range(2):
            page.wait(lambda: page.run(legend) == ["reference", "position", "position less model"], SLACK_S, "what is chosen")
            self.assertNotIn("Supply", self.titles())
            page.driver.refresh()
        page.click("#choose-plots")
        self.press("defaults", "#plots")
        page.wait(lambda: page.run(legend) == ["reference", "model", "position"] and "Supply" in self.titles(), SLACK_S, "as usual")

    def test_another_run_is_overlaid_in_a_pale_colour(self):
        page = self.page
        resistance = self.colour("resistance")
        pixels = lambda: self.painted("Resistance", resistance, 98, 106)  # noqa: E731: 40 % of it
        before = pixels()
        self.press("keep what is shown")
        page.wait(lambda: "drawn pale" in page.text("#run"), SLACK_S, "it is kept")
        # Half of the time: the run's begin lies under the middle of the log.
        ActionChains(page.driver).send_keys("+").perform()
        self.press("lay over what is shown")
        page.wait(lambda: pixels() > before + 100, SLACK_S, "the pale line")
        self.press("drop")
        page.wait(lambda: pixels() < before + 50, SLACK_S, "without it")
        page.click("#csv")
        page.find("#run [type=file]").send_keys(str(self.file("*.csv")))
        page.wait(lambda: ".csv, drawn pale" in page.text("#run"), 30.0, "it is loaded")

    def test_events_and_marks_are_drawn_as_lines(self):
        page = self.page
        page.run("const slider = document.querySelector('#replay input'); slider.value = 198; slider.dispatchEvent(new Event('input'));"
                 "document.querySelector('input[value=\"10\"]').click()")
        ink, fault = self.colour("ink-2"), self.colour("fault")
        page.wait(lambda: "198" in page.text("#replay output"), SLACK_S, "198 s")
        before = self.painted("Error", ink)
        ActionChains(page.driver).send_keys("m").perform()
        page.wait(lambda: "mark 1" in page.text(".journal"), SLACK_S, "it stands in what happened")
        page.wait(lambda: self.painted("Error", ink) > before + 30, SLACK_S, "a line")
        no_fault = self.painted("Error", fault)
        page.run("const slider = document.querySelector('#replay input'); slider.value = 205; slider.dispatchEvent(new Event('input'))")
        page.wait(lambda: self.painted("Error", fault) > no_fault + 30, SLACK_S, "a line at the fault")

    def test_a_plot_can_be_saved_as_png(self):
        self.press("PNG", "figure[aria-label^=Temperature]")
        picture = self.file("supercoil-node-1-temperature.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        width, height = (int.from_bytes(picture[i:i + 4]) for i in (16, 20))
        shown = self.page.run("const { width, height } = document.querySelector('figure[aria-label^=Temperature] canvas'); return [width, height]")
        self.assertEqual([width, height], [shown[0], shown[1] + 44])
        self.assertGreater(len(picture), 3000)


if __name__ == "__main__":
    unittest.main()
