"""The page shows a joint of two muscles: its angle, its reference, and what each muscle does.

    joint_test.py --picture     takes the picture of docs/joints.md instead

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import json
import math
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from modules import ModulesCase
from page_test import PICTURES, READY_S, STOP_S, PageCase
from programs import SLACK_S, SUPERCOIL, command, until
from selenium.webdriver.common.keys import Keys

CARD = "section[aria-label='joint of node {}']"
FOLLOWS_S = 60.0  # from the page's opening: the board starts, proves itself, and arms
JOINT_SCRIPT = """const { JointCard } = await import("/joint_card.js");
    const { protocol } = await (await fetch("/api/about")).json();
    const quantity = (name) => Number(Object.entries(protocol.Muscle.quantity.values).find(([, is]) => is === name)[0]);
    const store = new Store(protocol, true);
    const receive = (node, message, row, time_s = 1) =>
        store.append({ newest_s: 1, nodes: { [node]: { [message]: { time_s: [time_s], ...Object.fromEntries(Object.entries(row).map(([name, value]) => [name, [value]])) } } } });
    const muscle = (node, lever_m, other) => {
        receive(node, "Muscle", { quantity: quantity("joint_lever_7_m"), value: null }, 0.4);
        receive(node, "Muscle", { quantity: quantity("joint_lever_m"), value: lever_m }, 0.5);
        receive(node, "Muscle", { quantity: quantity("joint_other_node_offset"), value: other });
    };
    const shown = (node) => {
        const card = new JointCard(node, store);
        card.update(1);
        return card.element.hidden ? null : [card.limb.getAttribute("transform"), ...card.values.map(({ title, value }) => `${title.textContent}: ${value.textContent}`)];
    };
"""


class JointView(ModulesCase):
    def test_both_nodes_show_the_same_joint(self):
        results = self.run_script(JOINT_SCRIPT + """muscle(3, 0.02, -1); muscle(2, -0.02, 1);
            receive(3, "Measurement", { position_m: 0.01 }); receive(3, "Tracking", { reference_m: 0.0104 });
            receive(2, "Measurement", { position_m: -0.01 });
            receive(3, "Power", { applied_W: 1.25 }); receive(2, "Power", { applied_W: 0.5 });
            receive(3, "Temperature", { coldest_C: 40.2, hottest_C: 61.4 });
            return [shown(3), shown(2)];""")
        self.assertEqual(results[0], ["rotate(28.65)", "angle: 28.65°", "reference: 29.79°",
                                   "node 3, turns right: 1.25 W, 40 … 61 °C", "node 2, turns left: 0.50 W, – … – °C",
                                   "both pull with: –"])
        self.assertEqual(results[1], results[0])

    def test_shows_the_limit_of_either_muscle(self):
        limits = self.run_script(JOINT_SCRIPT + """muscle(3, 0.02, -1); muscle(2, -0.02, 1);
            const by = (name) => Number(Object.entries(protocol.Power.limited_by.values).find(([, is]) => is === name)[0]);
            receive(3, "Power", { applied_W: 0, limited_by: by("nothing") }); receive(2, "Power", { applied_W: 2, limited_by: by("maximum") });
            return shown(3).slice(3, 5);""")
        self.assertEqual(limits, ["node 3, turns right: 0.00 W, – … – °C", "node 2, turns left: 2.00 W, – … – °C, limited by maximum"])

    def test_a_spring_joint_has_one_node_and_one_direction(self):
        results = self.run_script(JOINT_SCRIPT + """const { joint_of, measure_of } = await import("/joint.js");
            muscle(1, 0.015, null);
            receive(1, "Measurement", { position_m: 0.003 });
            const joint = joint_of(store, 1, 1), { unit, both_ways, min_m } = measure_of(joint);
            return [joint.other, unit, both_ways, min_m(0.01), shown(1)[1]];""")
        self.assertEqual(results, [None, "°", False, 0, "angle: 11.46°"])

    def test_reads_the_other_muscles_travel(self):
        results = self.run_script(JOINT_SCRIPT + """muscle(1, 0.015, 1);
            const { joint_of } = await import("/joint.js");
            const words = ({ lever_m, ...rest }) => [lever_m.toFixed(6), rest.other, rest.other_travel_m?.toFixed(6)];
            const before = words(joint_of(store, 1, 1));
            const over_travel = Number(Object.entries(protocol.Limit.fault.values).find(([, is]) => is === "over_travel")[0]);
            receive(2, "Limit", { fault: over_travel, limit: 0.006 });
            return [before, words(joint_of(store, 1, 1))];""")
        self.assertEqual(results, [["0.015000", 2, None], ["0.015000", 2, "0.006000"]])

    def test_each_muscle_may_have_its_own_lever(self):
        results = self.run_script(JOINT_SCRIPT + """const { joint_of, measure_of } = await import("/joint.js");
            muscle(3, 0.02, -1); muscle(2, -0.01, 1);
            receive(3, "Measurement", { position_m: 0.01 }); receive(2, "Measurement", { position_m: -0.005 });
            const over_travel = Number(Object.entries(protocol.Limit.fault.values).find(([, is]) => is === "over_travel")[0]);
            receive(2, "Limit", { fault: over_travel, limit: 0.004 });
            return [shown(3)[1], shown(2)[1], measure_of(joint_of(store, 3, 1)).min_m(1).toFixed(6)];""")
        self.assertEqual(results, ["angle: 28.65°", "angle: 28.65°", "-0.008000"])

    def test_reads_a_lever_table(self):
        shown, typed_m = self.run_script(JOINT_SCRIPT + """const { joint_of, measure_of } = await import("/joint.js");
            const table = { first_rad: -0.5, last_rad: 0.5, "1_m": 0.012, "2_m": 0.015, "3_m": 0.011, "4_m": null };
            Object.entries(table).forEach(([name, value], i) => {
                for (const node of [2, 3]) receive(node, "Muscle", { quantity: quantity(`joint_lever_${name}`), value }, 0.1 + 0.01 * i);
            });
            muscle(3, 0.015, -1); muscle(2, -0.015, 1);
            receive(3, "Measurement", { position_m: 0.0065 + 0.0011 }); receive(3, "Tracking", { reference_m: -0.00675 + 0.012 * 0.25 + 0.003 * 0.25 ** 2 });
            const { to_m } = measure_of(joint_of(store, 3, 1));
            return [[shown(3), shown(2)], to_m(0.25 * 180 / Math.PI)];""")
        # By hand: 6.5 mm to the right end, then 0.1 rad at 11 mm; to the left -6.75 mm, and half of the way back.
        self.assertEqual([card[:3] for card in shown], 2 * [["rotate(34.38)", "angle: 34.38°", "reference: −14.32°"]])
        self.assertAlmostEqual(typed_m, 0.015 * 0.25 - 0.004 * 0.25 ** 2, 9)

    def test_shows_no_joint_until_all_quantities_arrived(self):
        results = self.run_script(JOINT_SCRIPT + """const names = ["joint_lever_m", "joint_other_node_offset", "joint_lever_first_rad", "joint_lever_last_rad",
                ...Array.from({ length: 7 }, (_, i) => `joint_lever_${i + 1}_m`)];
            const values = [0.015, 1, -0.5, 0.5, 0.012, 0.015, 0.011, null, null, null, null];
            return names.map((name, i) => {
                receive(1, "Muscle", { quantity: quantity(name), value: values[i] }, 0.1 + 0.01 * i);
                return shown(1) !== null;
            });""")
        self.assertEqual(results, 10 * [False] + [True])

    def test_a_single_or_unknown_muscle_has_no_joint(self):
        self.assertEqual(self.run_script(JOINT_SCRIPT + "muscle(1, null, null); return [shown(1), shown(2)];"), [None, None])

    def test_an_unknown_angle_is_not_drawn(self):
        self.assertEqual(self.run_script(JOINT_SCRIPT + "muscle(1, 0.015, 1); return shown(1).slice(0, 3);"), ["rotate(0)", "angle: –°", "reference: –°"])


class Angles(ModulesCase):
    SCRIPT = """const { Lever, measure_of } = await import("/joint.js");
        const { waveform, refuse_values, waveform_of_file } = await import("/waveform.js");
        const agonist = measure_of({ lever_m: 0.015, lever: new Lever([0.015]), other: 2 });
        const values = { offset: -5, amplitude: 20, period: 10 };
        """

    def test_only_the_agonists_position_is_an_angle(self):
        self.assertEqual(self.run_script(self.SCRIPT + """return [agonist, measure_of({ lever_m: -0.015, other: 1 }), measure_of(null)].map(({ unit, both_ways }) => [unit, both_ways]);"""),
                         [["°", True], ["mm", False], ["mm", False]])

    def test_joint_waveforms_are_in_degrees_of_both_signs(self):
        at_m, why = self.run_script(self.SCRIPT + """return [waveform("sine", values, agonist).at(2.5), refuse_values("sine", values, 0.008, agonist)];""")
        self.assertAlmostEqual(at_m, 0.0039270, 6)  # 15 degrees
        self.assertEqual(why, "")
        self.assertEqual(self.run_script(self.SCRIPT + """return refuse_values("sine", { ...values, offset: 15 }, 0.008, agonist);"""),
                         "offset and amplitude reach from -5.00 to 35.00 °; allowed: -30.56 to 30.56 °")

    def test_range_includes_the_other_muscles_travel(self):
        self.assertEqual(self.run_script(self.SCRIPT + """return refuse_values("sine", { ...values, amplitude: 25 }, 0.008, measure_of({ lever_m: 0.015, lever: new Lever([0.015]), other: 2, other_travel_m: 0.006 }));"""),
                         "offset and amplitude reach from -30.00 to 20.00 °; allowed: -22.92 to 30.56 °")

    def test_a_file_of_a_joint_may_have_negative_positions(self):
        results = self.run_script(self.SCRIPT + """const why = (row, measure) => { try { waveform_of_file(`time_s,position_m\n0,0\n1,${row}\n`, 0.008, measure); return ""; } catch ({ message }) { return message; } };
            return [why(-0.008, agonist), why(-0.009, agonist), why(-0.008)];""")
        self.assertEqual(results, ["", "line 3: position_m -0.009; allowed: -0.008 to 0.008 m", "line 3: position_m -0.008; allowed: 0 to 0.008 m"])


class JointPage(PageCase):
    scenario = "joint"

    def angle_deg(self, page, node):
        """And its reference; None while one of them is not shown."""
        found = re.search(r"angle\s*(-?[\d.]+)°\s*reference\s*(-?[\d.]+)°", page.text(CARD.format(node)).replace("−", "-"))
        return found and tuple(map(float, found.groups()))


class RunningJointPage(JointPage):
    def test_a_tracking_joint_turns_on_the_page(self):
        page = self.page()
        page.wait(lambda: (self.angle_deg(page, 1) or (0.0, 0.0))[0] > 10.0, FOLLOWS_S, "turned right")
        page.wait(lambda: (self.angle_deg(page, 1) or (0.0, 0.0))[0] < -10.0, 30.0, "turned left")
        heats = re.findall(r"node (\d), turns (right|left)\s*([\d.]+) W", page.text(CARD.format(1)))
        self.assertEqual([heat[:2] for heat in heats], [("1", "right"), ("2", "left")])
        self.assertGreater(float(heats[1][2]), float(heats[0][2]), "what turns it left pulls more there")
        self.assertRegex(page.text(CARD.format(1)), r"both pull with\s*1\.00 W of node 2, commanded")
        self.assertEqual(page.errors(), [])


class FreeJointPage(JointPage):
    """A joint that nobody else commands."""

    keys = ""

    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        file = pathlib.Path(folder, "joint.toml")
        file.write_text(f"[simulation]\nduration_s = 86400.0\n[joint]\n{cls.keys}[operator]\naction = 'none'\n"
                        "[controller]\nkind = 'learned_ff'\n")
        cls.scenario = str(file)
        super().setUpClass()


class JointByHand(FreeJointPage):
    def type_angle(self, page, angle):
        field = page.find(".manual .value input")
        field.clear()
        field.send_keys(str(angle), Keys.ENTER)

    def test_an_angle_turns_it_both_ways(self):
        page = self.page()
        page.wait(lambda: page.text(".manual .value .unit") == "°", READY_S, "the joint is reported")
        unit = page.find("#wave-amplitude-1 + .unit").get_attribute("textContent")
        self.assertEqual(unit, "°")
        page.arm()
        for angle in (8, -8):
            self.type_angle(page, angle)
            page.wait(lambda: abs((self.angle_deg(page, 1) or (99.0, 0.0))[0] - angle) < 0.3, FOLLOWS_S, f"at {angle} degrees")
        self.type_angle(page, -60)
        page.wait(lambda: re.search(r"allowed: -\d+\.\d+ to \d+\.\d+ °", page.text(".manual .answer")), STOP_S, "refused with the range")
        page.press_space()
        page.wait(page.is_off, STOP_S, "off")
        self.assertEqual(page.errors(), [])

    def test_calibrate_measures_both_muscles(self):
        until(lambda: command(self.source, "1", "arm").returncode == 0)
        done = command(self.source, "1", "calibrate", "--for", "120", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([json.loads(line) for line in done.stdout.splitlines()],
                         [{"command": f"{node} calibrate", "result": "found"} for node in (1, 2)])

    def published_angle_deg(self):
        agonist, _ = json.loads(command(self.source, "state", "--json").stdout)["nodes"]
        return math.degrees(agonist["Measurement"]["position_m"] / 0.015)

    def test_command_takes_degrees(self):
        for word in ("disarm", "reset"):
            command(self.source, "1", word)
        until(lambda: command(self.source, "1", "arm").returncode == 0)
        held = subprocess.Popen([SUPERCOIL, "command", "1", "position", "-6deg", "--for", "15", "--can", self.source],
                                stderr=subprocess.PIPE, text=True)
        self.addCleanup(held.kill)
        until(lambda: abs(self.published_angle_deg() + 6.0) < 0.5)
        self.assertEqual((held.communicate(timeout=2 * SLACK_S)[1], held.returncode), ("", 0))
        self.assertIn("out_of_range; 0.007992 would be obeyed", command(self.source, "1", "position", "90°").stderr)
        self.assertIn("out_of_range; 0.007992 would be obeyed", command(self.source, "1", "position", "90deg").stderr)
        # About -3 to +7 degrees, in a period in which the joint follows.
        held = subprocess.Popen([SUPERCOIL, "command", "1", "position", "2°", "--amplitude", "5deg", "--period", "11", "--hold", "--can", self.source],
                                stderr=subprocess.PIPE, text=True)
        self.addCleanup(held.kill)
        until(lambda: 5.5 < self.published_angle_deg() < 8.0, 40.0)
        until(lambda: -4.0 < self.published_angle_deg() < -1.5, 40.0)
        held.send_signal(signal.SIGINT)
        self.assertEqual(held.communicate(timeout=2 * SLACK_S)[1].strip(), "")


class SpringJoint(FreeJointPage):
    keys = "opposed_by = 'spring'\n"

    def test_a_spring_joint_takes_degrees(self):
        until(lambda: command(self.source, "1", "arm").returncode == 0)
        held = subprocess.Popen([SUPERCOIL, "command", "1", "position", "12deg", "--hold", "--can", self.source])
        self.addCleanup(held.wait)
        self.addCleanup(held.kill)
        page = self.page()
        page.wait(lambda: abs((self.angle_deg(page, 1) or (99.0, 99.0))[0] - 12.0) < 0.3, FOLLOWS_S, "it is there")
        card = page.text(CARD.format(1))
        self.assertRegex(card, r"node 1, turns right")
        self.assertNotIn("turns left", card)
        self.assertNotIn("both pull", card)
        self.assertEqual(page.text(".manual .value .unit"), "°")
        self.assertEqual(page.errors(), [])


class LeverTableJoint(FreeJointPage):
    keys = "lever_m = [0.012, 0.015, 0.011]\nlever_range_deg = [-30.0, 30.0]\n"

    def test_an_angle_is_converted_by_the_levers_integral(self):
        angle = math.radians(-12.0)
        arc_m = 0.015 * angle + 0.5 * 0.003 / math.radians(30.0) * angle ** 2
        until(lambda: command(self.source, "1", "arm").returncode == 0)
        # As far as the sensor reads, 7.992 mm of the lever at 0: the muscle contracts by less on the way there.
        self.assertIn("0.006908 would be obeyed (30.52", command(self.source, "1", "position", "90deg").stderr)
        held = subprocess.Popen([SUPERCOIL, "command", "1", "position", "-12deg", "--hold", "--can", self.source])
        self.addCleanup(held.wait)
        self.addCleanup(held.kill)

        def reference_m():
            return json.loads(command(self.source, "state", "--json").stdout)["nodes"][0]["Tracking"]["reference_m"]
        until(lambda: abs((reference_m() or 0.0) - arc_m) < 1e-7)
        page = self.page()
        page.wait(lambda: abs((self.angle_deg(page, 1) or (99.0, 99.0))[1] + 12.0) < 0.011, READY_S, "the page shows -12 degrees")
        page.wait(lambda: abs((self.angle_deg(page, 1) or (99.0, 99.0))[0] + 12.0) < 0.3, FOLLOWS_S, "it is there")


class Picture(JointPage):
    """The picture of a joint that moves; a test run does not find it."""

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
