"""A browser in which the page's modules are tested one by one."""

import json
import unittest

from browser import Browser
from hour_source import HourSource

# Rows of one signal v, at 100 Hz from a time on.
TOOLS = """
const { Table } = await import("/table.js");
const { decimate } = await import("/decimate.js");
const { Store } = await import("/store.js");
const { markdown } = await import("/markdown.js");
const rows = (from_s, count, value, period_s = 0.01) => ({
  time_s: Array.from({ length: count }, (_, i) => from_s + i * period_s),
  v: Array.from({ length: count }, (_, i) => value(i)),
});
const full = (from_s, count, value) => {
  const table = new Table(["v"], 3600);
  table.append(rows(from_s, count, value));
  return table;
};
const drawn = (line) => Array.from(line, (v) => (v === undefined ? "-" : v === null ? "0" : v)).join("");
const length = (table) => table.chunks.reduce((sum, chunk) => sum + chunk.count, 0);
"""

# A state card of node 1 and the store that it shows.
CARD = """const { StateCard } = await import("/state_card.js");
    const { protocol, protocol_version } = await (await fetch("/api/about")).json();
    const store = new Store(protocol, false);
    const card = new StateCard(1, store, () => {}, protocol_version);
    card.element.dataset = {};  // this document is an image
    const notes = ["theta1_kept", "theta2_uncertain", "theta3_uncertain", "theta4_uncertain", "poor_fit", "implausible", "too_little_motion", "friction"];
    (await import("/results.js")).take_results({ none: "", running: "", found: "stored", poor_fit: "play", interrupted: "ended" },
        notes.map((name) => ({ name, words: name.replaceAll("_", " ") })));
"""


class ModulesCase(unittest.TestCase):
    """Tests that run scripts beside the page's modules."""

    @classmethod
    def setUpClass(cls):
        cls.source = HourSource()
        cls.addClassCleanup(cls.source.server_close)
        cls.addClassCleanup(cls.source.shutdown)
        cls.browser = cls.enterClassContext(Browser())
        cls.browser.driver.get(cls.source.address + "icon.svg")

    def run_script(self, script):
        """What the script returns."""
        answer = self.browser.driver.execute_async_script(
            "const done = arguments[0]; (async () => {" + TOOLS + script + "})()"
            ".then((value) => done(JSON.stringify({ value: value ?? null })), (error) => done(JSON.stringify({ error: String(error.stack) })))")
        answer = json.loads(answer)
        self.assertNotIn("error", answer)
        return answer["value"]
