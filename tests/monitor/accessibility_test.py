"""The live page is for everybody: axe-core finds nothing in light, dark and on a phone, and nothing overlaps at any width.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import pathlib
import tempfile
import unittest

from page_test import PageCase
from programs import ROOT, log_of, monitor

AXE = (ROOT / "toolchain" / "page" / "node_modules" / "axe-core" / "axe.min.js").read_text()
LAYOUT = (pathlib.Path(__file__).with_name("layout.js")).read_text()
LEAST_TARGET_PX = 24
WIDTHS = sorted({*range(320, 1921, 160), 360, 641, 900, 901, 1250, 1251})
LOADED_S = 30.0
# Every rule but the experimental ones, and those that are off unless asked for.
AUDIT = """const done = arguments[1];
    axe.run(arguments[0], { resultTypes: ["violations"], rules: { "target-size": { enabled: true } } }).then(({ violations }) =>
        done(violations.flatMap(({ id, nodes }) => nodes.map(({ html, any }) => `${id}: ${html.slice(0, 160)} ${any[0]?.message ?? ""}`))))"""
SETTLED = "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(() => done())))"


class AccessibilityTest(PageCase):
    maxDiff = 0

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.replay = monitor(log_of("first-motion", folder))
        cls.addClassCleanup(cls.replay.stop)

    def opened(self, address):
        """With all that can be opened, and with all that comes one after the other."""
        page = self.page(address)
        page.wait(lambda: "over temperature" in page.text(".margins"), LOADED_S, "all detectors")
        page.run("for (const card of document.querySelectorAll('details')) card.open = true")
        if page.find(".manual").is_displayed():
            page.wait(lambda: "adaptation scale" in page.text("details tbody"), LOADED_S, "the controllers are read")
        return page

    def settle(self, page, width, height, scheme="light", mobile=False):
        page.screen(width, height, mobile)
        page.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme},
                                                         {"name": "prefers-reduced-motion", "value": "reduce"}])
        page.driver.execute_async_script(SETTLED)

    def audit(self, page, place):
        for width, height, scheme, mobile in ((1440, 1000, "light", False), (1440, 1000, "dark", False), (390, 844, "light", True)):
            self.settle(page, width, height, scheme, mobile)
            with self.subTest(place, width=width, scheme=scheme):
                found = page.driver.execute_async_script(AUDIT, place)
                self.assertEqual(found, [], "\n" + "\n".join(found))

    def lay_out(self, page, widths):
        found = {}
        for width in widths:
            self.settle(page, width, 900)
            for problem in page.driver.execute_script(LAYOUT, LEAST_TARGET_PX):
                found.setdefault(problem, []).append(width)
        with self.subTest("layout"):
            self.assertEqual(found, {}, "\n" + "\n".join(f"{problem}, at {widths} px" for problem, widths in found.items()))

    def check(self, address, widths):
        page = self.opened(address)
        page.run(AXE)
        self.audit(page, "html")
        self.lay_out(page, widths)
        page.run("document.querySelector('#keys').click()")
        self.audit(page, "#help")
        page.run("document.querySelector('#keys').click(); document.querySelector('#choose-plots').click()")
        self.audit(page, "#plots")
        page.run("document.querySelector('#choose-plots').click(); document.querySelector('.margins .link').click()")
        page.wait(lambda: page.text("#fault-page article") != "", LOADED_S, "a fault's page")
        self.audit(page, "#fault-page")

    def test_page_of_a_board(self):
        self.check(self.address, WIDTHS)

    def test_page_of_a_log(self):
        # It has less than a board's page.
        self.check(self.replay.found[0], WIDTHS[::3])


if __name__ == "__main__":
    unittest.main()
