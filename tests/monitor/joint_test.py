"""The page shows a joint of two muscles: its angle, its reference, and what each muscle does.

    joint_test.py --picture     takes the picture of docs/joints.md instead

Programs: environment SUPERCOIL and SUPERCOIL_SIM, else those of build/release.
"""

import re
import sys
import time
import unittest

from modules import ModulesCase
from page_test import PICTURES, PageCase

CARD = "section[aria-label='joint of node {}']"
FOLLOWS_S = 60.0  # from the page's opening: the board starts, proves itself, and arms
TOLD = """const { JointCard } = await import("/joint_card.js");
    const { protocol } = await (await fetch("/api/about")).json();
    const quantity = (name) => Number(Object.entries(protocol.Muscle.quantity.values).find(([, is]) => is === name)[0]);
    const store = new Store(protocol, true);
    const hear = (node, message, row, time_s = 1) =>
        store.append({ newest_s: 1, nodes: { [node]: { [message]: { time_s: [time_s], ...Object.fromEntries(Object.entries(row).map(([name, value]) => [name, [value]])) } } } });
    const muscle = (node, lever_m, other) => {
        hear(node, "Muscle", { quantity: quantity("joint_lever_m"), value: lever_m }, 0.5);
        hear(node, "Muscle", { quantity: quantity("joint_other_node_offset"), value: other });
    };
    const shown = (node) => {
        const card = new JointCard(node, store);
        card.update(1);
        return card.element.hidden ? null : [card.limb.getAttribute("transform"), ...card.values.map(({ title, value }) => `${title.textContent}: ${value.textContent}`)];
    };
"""


class Told(ModulesCase):
    def test_both_nodes_show_the_joint_of_the_muscle_that_turns_it_right(self):
        told = self.ask(TOLD + """muscle(3, 0.02, -1); muscle(2, -0.02, 1);
            hear(3, "Measurement", { position_m: 0.01 }); hear(3, "Tracking", { reference_m: 0.0104 });
            hear(2, "Measurement", { position_m: -0.01 });
            hear(3, "Power", { applied_W: 1.25 }); hear(2, "Power", { applied_W: 0.5 });
            hear(3, "Temperature", { coldest_C: 40.2, hottest_C: 61.4 });
            return [shown(3), shown(2)];""")
        self.assertEqual(told[0], ["rotate(28.65)", "angle: 28.65°", "reference: 29.79°",
                                   "node 3, turns right: 1.25 W, 40 … 61 °C", "node 2, turns left: 0.50 W, – … – °C"])
        self.assertEqual(told[1], told[0])

    def test_a_muscle_alone_and_one_that_was_not_asked_have_no_joint(self):
        self.assertEqual(self.ask(TOLD + "muscle(1, null, null); return [shown(1), shown(2)];"), [None, None])

    def test_an_angle_that_is_not_known_is_not_drawn_as_one(self):
        self.assertEqual(self.ask(TOLD + "muscle(1, 0.015, 1); return shown(1).slice(0, 3);"), ["rotate(0)", "angle: –°", "reference: –°"])


class OfJoint(PageCase):
    scenario = "joint"

    def angle_deg(self, page, node):
        """And its reference; None while one of them is not shown."""
        found = re.search(r"angle\s*(-?[\d.]+)°\s*reference\s*(-?[\d.]+)°", page.text(CARD.format(node)).replace("−", "-"))
        return found and tuple(map(float, found.groups()))


class OnThePage(OfJoint):
    def test_a_joint_that_follows_is_seen_to_turn(self):
        page = self.page()
        page.wait(lambda: (self.angle_deg(page, 1) or (0.0, 0.0))[0] > 10.0, FOLLOWS_S, "turned right")
        page.wait(lambda: (self.angle_deg(page, 1) or (0.0, 0.0))[0] < -10.0, 30.0, "turned left")
        heats = re.findall(r"node (\d), turns (right|left)\s*([\d.]+) W", page.text(CARD.format(1)))
        self.assertEqual([heat[:2] for heat in heats], [("1", "right"), ("2", "left")])
        self.assertGreater(float(heats[1][2]), float(heats[0][2]), "what turns it left pulls more there")
        self.assertEqual(page.errors(), [])


class Picture(OfJoint):
    """Of a joint that moves; no test finds it by itself."""

    def take(self):
        page = self.page()
        page.wait(lambda: (self.angle_deg(page, 1) or (0.0, 0.0))[0] > 10.0, FOLLOWS_S, "turned right")
        time.sleep(7.0)
        page.find(CARD.format(1)).screenshot(str(PICTURES / "joint.png"))


if __name__ == "__main__":
    if "--picture" in sys.argv:
        unittest.TextTestRunner(verbosity=2).run(Picture("take"))
    else:
        unittest.main()
