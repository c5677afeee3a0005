"""Three muscles that pull together, each with its own heater: commanded by the leader's node, and what the page says of the rest.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import json
import subprocess
import unittest

from modules import ModulesCase
from page_test import READY_S, PageCase
from programs import SUPERCOIL, command, until


class BundleLeader(ModulesCase):
    def test_leader_is_reported_by_the_board(self):
        leaders = self.run_script("""const { leader_of } = await import("/joint.js");
            const { protocol } = await (await fetch("/api/about")).json();
            const quantity = Number(Object.entries(protocol.Muscle.quantity.values).find(([, is]) => is === "bundle_leader_node_offset")[0]);
            const store = new Store(protocol, true);
            const receive = (node, value) => store.append({ newest_s: 1, nodes: { [node]: { Muscle: { time_s: [1], quantity: [quantity], value: [value] } } } });
            receive(1, null); receive(3, -2);
            return [leader_of(store, 1, 1), leader_of(store, 2, 1), leader_of(store, 3, 1)];""")
        self.assertEqual(leaders, [None, None, 1])


class BundlePage(PageCase):
    scenario = "bundle-bench"

    def nodes(self):
        return json.loads(command(self.source, "state", "--json").stdout)["nodes"]

    def test_every_muscle_gets_the_leaders_power(self):
        until(lambda: command(self.source, "1", "arm").returncode == 0)
        done = command(self.source, "1", "power", "1.0", "--for", "3")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        held = subprocess.Popen([SUPERCOIL, "command", "1", "power", "1.0", "--for", "15", "--can", self.source])
        self.addCleanup(held.wait)
        self.addCleanup(held.kill)
        modes = lambda: [node["Status"]["mode"] for node in self.nodes()]  # noqa: E731
        until(lambda: modes() == ["power", "bundle", "bundle"])
        until(lambda: all(abs(node["Power"]["applied_W"] - 1.0) < 0.02 for node in self.nodes()))
        held.kill()
        held.wait()
        until(lambda: modes() == 3 * ["rest"])
        for word in ("reset", "arm"):
            command(self.source, "2", word)
        self.assertEqual(command(self.source, "1", "calibrate", "--for", "120", "--json").returncode, 0)
        refused = command(self.source, "3", "power", "1.0")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("wrong_state", refused.stderr)

    def test_page_names_the_leader_on_a_followers_tab(self):
        page = self.page()
        tabs = lambda: page.driver.find_elements("css selector", "#tabs [role=tab]")  # noqa: E731
        page.wait(lambda: len(tabs()) == 4, READY_S, "three nodes, and one for all")
        tabs()[1].click()
        page.wait(lambda: any(hint.is_displayed() and "Node 1 leads the bundle" in hint.text for hint in page.driver.find_elements("css selector", ".manual .hint")),
                  READY_S, "node 2 follows")
        self.assertEqual(page.errors(), [])


if __name__ == "__main__":
    unittest.main()
