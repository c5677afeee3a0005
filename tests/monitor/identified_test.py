"""The page shows which parameters a board uses for its muscle, and since when.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import unittest

from modules import ModulesCase
from page_test import PageCase
from programs import SLACK_S

CARD = "section[aria-label='muscle in use, node 1']"
IDENTIFIED = """const { Identified } = await import("/identified.js");
    const { protocol } = await (await fetch("/api/about")).json();
    const number = (message, signal, name) => Number(Object.entries(protocol[message][signal].values).find(([, is]) => is === name)[0]);
    const store = new Store(protocol, true);
    const card = new Identified(1, store, false);
    const receive = (time_s, message, row) =>
        store.append({ newest_s: time_s, nodes: { 1: { [message]: { time_s: [time_s], ...Object.fromEntries(Object.entries(row).map(([name, value]) => [name, [value]])) } } } });
    const status = (time_s, mode, result) => receive(time_s, "Status", { mode: number("Status", "mode", mode), result: number("Status", "result", result) });
    const muscle = (time_s, values) => Object.entries(values).forEach(([name, value], i) =>
        receive(time_s + i * 0.001, "Muscle", { quantity: number("Muscle", "quantity", name), value }));
    const shown = (time_s) => { card.update(time_s); return card.since.textContent; };
"""


class IdentifiedCard(ModulesCase):
    def test_shows_since_when_the_result_is_in_use(self):
        texts = self.run_script(IDENTIFIED + """const values = (deviation) => ({ stiffness_N_per_m: 16, theta4_deviation_ratio: deviation });
            const texts = [shown(0)];
            status(1, "rest", "none"); muscle(1, values(null)); texts.push(shown(2));
            status(3, "identify", "running"); status(4, "rest", "found"); muscle(4.1, values(0.02)); status(5, "rest", "found"); texts.push(shown(5));
            status(6, "calibrate", "running"); status(7, "rest", "found"); texts.push(shown(7));
            status(8, "identify", "running"); status(9, "rest", "uncertain"); texts.push(shown(9));
            return texts;""")
        self.assertEqual(texts, ["No program asked the board for it in this log.", "Not identified since the board started: configured, or stored from before.",
                                "Identified; in use since 4.0 s.", "Identified; in use since 4.0 s.", "Identified; in use since 4.0 s."])

    def test_an_identification_before_the_page_is_marked(self):
        self.assertEqual(self.run_script(IDENTIFIED + """status(1, "rest", "found"); muscle(1, { stiffness_N_per_m: 16, theta4_deviation_ratio: 0.02 });
            return shown(2);"""), "Identified since the board started, before this page's data begins.")

    def test_an_identification_before_the_board_started_has_its_date(self):
        self.assertEqual(self.run_script(IDENTIFIED + """status(1, "rest", "none");
            muscle(1, { stiffness_N_per_m: 16, theta4_deviation_ratio: 0.02, identified_s: 1795219200 });
            return [shown(2), card.rows.get("theta4")[1].textContent];"""),
            ["Identified 2026-11-21 00:00 UTC, before the board started.", "± 2.00 %"])

    def test_theta_follows_from_the_parameters_in_use(self):
        self.assertEqual(self.run_script(IDENTIFIED + """muscle(1, { thermal_mass_J_per_K: 2, heat_transfer_W_per_K: 3, stiffness_N_per_m: 5, damping_Ns_per_m: 7,
                moving_mass_kg: 11, force_per_kelvin_N_per_K: 0.5, theta2_deviation_ratio: 0.034 });
            card.update(2);
            return ["theta1", "theta2", "theta3", "theta4"].map((name) => card.rows.get(name).map((cell) => cell.textContent));"""),
            [["4.00", "–", "–"], ["94.0", "± 3.40 %", "–"], ["62.0", "–", "–"], ["30.0", "–", "–"]])

    def test_configured_values_are_shown_beside(self):
        self.assertEqual(self.run_script(IDENTIFIED + """muscle(1, { stiffness_N_per_m: 5, configured_stiffness_N_per_m: 16, cold_resistance_Ohm: 9, configured_cold_resistance_Ohm: 10,
                configured_thermal_mass_J_per_K: 2, configured_force_per_kelvin_N_per_K: 0.5 });
            card.update(2);
            return ["stiffness_N_per_m", "cold_resistance_Ohm", "theta1"].map((name) => card.rows.get(name).map((cell) => cell.textContent));"""),
            [["5.00", "–", "16.0"], ["9.00", "–", "10.0"], ["–", "–", "4.00"]])

    def test_time_constant_and_gain_are_derived(self):
        self.assertEqual(self.run_script(IDENTIFIED + """muscle(1, { thermal_mass_J_per_K: 2, heat_transfer_W_per_K: 4, stiffness_N_per_m: 5, force_per_kelvin_N_per_K: 0.5,
                configured_thermal_mass_J_per_K: 2, configured_heat_transfer_W_per_K: 5 });
            card.update(2);
            return ["time_constant", "gain"].map((name) => card.rows.get(name).map((cell) => cell.textContent));"""),
            [["0.500", "–", "0.400"], ["25.0", "–", "–"]])

    def test_derived_deviations_are_shown_only_for_current_values(self):
        self.assertEqual(self.run_script(IDENTIFIED + """const now = globalThis.fetch;
            const sent = { stiffness_N_per_m: 16.1, theta2_deviation_ratio: 0.02, theta3_deviation_ratio: 0.01, theta4_deviation_ratio: 0.01 };
            globalThis.fetch = async () => new Response(JSON.stringify({ ...sent, stiffness_N_per_m_deviation_ratio: 0.034, time_constant_deviation_ratio: 0.0048 }));
            const asking = new Identified(1, store, true);
            const cells_at = (time_s) => {
                asking.update(time_s);
                return ["stiffness_N_per_m", "time_constant", "damping_Ns_per_m", "theta2"].map((name) => asking.rows.get(name)[1].textContent);
            };
            status(0, "rest", "none");
            const before = cells_at(0.5);
            while (!asking.answer.stiffness_N_per_m) await new Promise((done) => setTimeout(done, 5));
            globalThis.fetch = now;
            muscle(1, sent);
            const same = cells_at(2);
            muscle(3, { stiffness_N_per_m: 17 });
            return [before, same, cells_at(4)];"""),
            [["–"] * 4, ["± 3.40 %", "± 0.480 %", "–", "± 2.00 %"], ["–", "–", "–", "± 2.00 %"]])


class IdentifiedPage(PageCase):
    def test_the_card_queries_the_board(self):
        page = self.page()
        page.wait(lambda: "Not identified since the board started" in page.text(CARD), SLACK_S, "what it goes by")
        page.wait(lambda: "–" not in page.text(f"{CARD} tbody tr:nth-child(7) td"), SLACK_S, "the first quantity")
        self.assertEqual(page.errors(), [])
        answer = page.run("return fetch('/api/muscle/1').then((answer) => answer.json())")
        self.assertEqual(len(answer), 44 + 6)
        for name in ("thermal_mass_J_per_K", "heat_transfer_W_per_K", "stiffness_N_per_m", "damping_Ns_per_m", "time_constant", "gain"):
            self.assertIsNone(answer[f"{name}_deviation_ratio"])
        self.assertIsNone(answer["theta1_deviation_ratio"])
        self.assertIsNone(answer["joint_lever_m"])
        self.assertFalse(page.run("return [...document.querySelectorAll('.joint')].some((card) => card.checkVisibility())"))
        rows = page.run(f"""return [...document.querySelectorAll("{CARD} tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent))""")
        self.assertIn(["stiffness", f"{answer['stiffness_N_per_m']:.1f}", "N/m", "–", f"{answer['configured_stiffness_N_per_m']:.1f}"], rows)
        self.assertIn(["sensor at zero", "0", "m", "–", "–"], rows)
        self.assertEqual(page.run("return fetch('/api/muscle/64').then(({ status }) => status)"), 400)


if __name__ == "__main__":
    unittest.main()
