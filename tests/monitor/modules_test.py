"""The page's modules, one by one, in a real browser: what a plot shows of many rows, what is kept, what a text becomes."""

import unittest

from modules import CARD, ModulesCase


class ModulesTest(ModulesCase):
    def test_a_single_peak_stays_visible_in_an_hour(self):
        points = self.run_script("""const table = full(0, 360000, (i) => (i === 123457 ? 7 : Math.sin(i)));
            const [line] = decimate(table, ["v"], 0, 3600, 500, 1);
            return [Math.max(...line), Math.min(...line), line.length, line.indexOf(7)];""")
        self.assertEqual(points[0], 7)
        self.assertAlmostEqual(points[1], -1, places=3)
        self.assertEqual(points[2], 1000)
        self.assertAlmostEqual(points[3] / 1000, 123457 / 360000, delta=0.002)

    def test_numbered_children_are_sorted(self):
        self.assertEqual(self.run_script("""const { place } = await import("/dom.js");
            const page = document.implementation.createHTMLDocument();
            const list = page.createElement("ul");
            for (const number of [30, 2, 100, 10]) place(list, number, page.createElement("li"));
            return [...list.children].map((child) => Number(child.dataset.number));"""), [2, 10, 30, 100])

    def test_points_within_a_pixel_keep_their_order(self):
        self.assertEqual(self.run_script("""const table = full(0, 4, (i) => [5, 4, 1, 2][i]);
            return decimate(table, ["v"], 0, 0.04, 1, 1)[0];"""), [5, 1])

    def test_line_bridges_sparse_rows_and_breaks_at_gaps(self):
        line = self.run_script("""const table = new Table(["v"], 3600);
            table.append(rows(0, 20, () => 1, 0.1));
            table.append(rows(6, 20, () => 2, 0.1));
            return drawn(decimate(table, ["v"], 0, 8, 160, 1)[0]);""")
        # From the pixel after the last row to the one before the next: uPlot leaves out what lies beside a null and no more.
        self.assertRegex(line, r"^[1-]{76,80}0{158,166}2[2-]*$")

    def test_a_pause_breaks_the_line_over_a_long_time(self):
        line = self.run_script("""const table = full(0, 100, () => 1);
            table.append(rows(1000, 100000, () => 2));
            return drawn(decimate(table, ["v"], 0, 2000, 500, 1)[0]);""")
        self.assertRegex(line, r"^1-0{498}2-")

    def test_row_period_ignores_pauses(self):
        self.assertEqual(self.run_script("""const table = full(0, 10, () => 1);
            table.append(rows(1000, 8, () => 1));
            const slow = new Table(["v"], 3600);
            slow.append(rows(0, 5, () => 1, 2));
            return [table.period_s.toFixed(3), slow.period_s, new Table(["v"], 3600).period_s];"""), ["0.010", 2, 0])

    def test_tick_labels_have_enough_decimals(self):
        self.assertEqual(self.run_script("""const { decimals_of } = await import("/format.js");
            return [2.5, 0.25, 0.1, 0.5, 1, 5, 10, 100, 0.001, 0.025].map(decimals_of);"""), [1, 2, 1, 1, 0, 0, 0, 0, 3, 3])

    def test_remaining_time_is_shown_when_it_is_known(self):
        self.assertEqual(self.run_script(CARD + """const number = (signal, name) => Number(Object.entries(protocol.Status[signal].values).find(([, is]) => is === name)[0]);
            const shown = (time_s, mode, progress) => {
                store.append({ newest_s: time_s, nodes: { 1: { Status: { time_s: [time_s], state: [number("state", "active")],
                    mode: [number("mode", mode)], progress: [progress], result: [number("result", "running")], protocol_version: [protocol_version] } } } });
                card.update(time_s);
                return card.percent.textContent;
            };
            return [shown(10, "identify", 0.1), shown(11, "identify", 0.2), shown(14, "identify", 0.3), shown(20, "identify", 0.6),
                shown(21, "calibrate", 0.5), shown(31, "calibrate", 0.51), shown(41, "calibrate", 0.88), shown(42, "calibrate", 0.0)];"""),
            ["identify: 10 %", "identify: 20 %", "identify: 30 %, 14 s left", "identify: 60 %, 8 s left",
             "calibrate: 50 %", "calibrate: 51 %", "calibrate: 88 %, 6 s left", "calibrate: 0 %"])

    def test_state_shows_the_hottest_temperature_and_never_cold(self):
        texts = self.run_script("""const { StateCard } = await import("/state_card.js");
            const { protocol, protocol_version } = await (await fetch("/api/about")).json();
            const texts = {};
            for (const [number, state] of Object.entries(protocol.Status.state.values)) {
                const store = new Store(protocol, false);
                const card = new StateCard(1, store, () => {}, protocol_version);
                card.element.dataset = {};  // this document is an image
                const shown = (time_s, hottest_C) => {
                    const status = { time_s: [time_s], state: [Number(number)], protocol_version: [protocol_version] };
                    const temperature = hottest_C === undefined ? {} : { Temperature: { time_s: [time_s], hottest_C: [hottest_C] } };
                    store.append({ newest_s: time_s, nodes: { 1: { Status: status, ...temperature } } });
                    card.update(time_s);
                    return card.means.textContent;
                };
                texts[state] = [shown(1), shown(2, 82.3), shown(3, 26.9), shown(4, null), shown(6)];
            }
            return texts;""")
        for state, is_said in (("disarmed", "off, cannot heat"), ("armed", "off, ready to heat"), ("active", "heats"),
                               ("fault", "off, needs a reset")):
            still = "" if state == "active" else "still "
            unknown = f"{is_said}; temperature not known"
            self.assertEqual(texts[state], [unknown, f"{is_said}; may {still}be at 83 °C", f"{is_said}; at most 27 °C",
                                           unknown, unknown], state)

    def test_an_old_resistance_is_dimmed(self):
        self.assertEqual(self.run_script("""const { Readouts } = await import("/readouts.js");
            const { protocol } = await (await fetch("/api/about")).json();
            const store = new Store(protocol, false);
            const readouts = new Readouts(1, store);
            const number = [...readouts.element.querySelectorAll("dt")].find((dt) => dt.textContent === "resistance").nextSibling.firstChild;
            const shown = (time_s, resistance_age_s) => {
                const row = { time_s: [time_s], resistance_Ohm: [12.8], resistance_age_s: [resistance_age_s] };
                store.append({ newest_s: time_s, nodes: { 1: { Measurement: row } } });
                readouts.update(time_s);
                return [number.textContent, number.classList.contains("old"), number.title ?? ""];
            };
            return [shown(1, 0.01), shown(2, 34.4), shown(3, null), shown(4, 0)];"""),
            [["12.800", False, ""], ["12.800", True, "measured 34 s ago"],
             ["12.800", True, "not measured for a long time, or never"], ["12.800", False, ""]])

    def test_unavailable_values_are_gaps(self):
        self.assertEqual(self.run_script("""const table = full(0, 3, (i) => (i === 1 ? null : i));
            return decimate(table, ["v"], 0, 0.03, 3, 1)[0].filter((v) => v !== undefined);"""), [0, None, 2])

    def test_one_hour_is_kept(self):
        first_s, kept = self.run_script("""const table = new Table(["v"], 3600);
            for (let t = 0; t < 5000; t += 10) table.append(rows(t, 1000, (i) => i));
            return [table.first_s, length(table)];""")
        self.assertLessEqual(first_s, 1400)
        self.assertGreater(first_s, 1300)
        self.assertLess(kept, 365_000)

    def test_duplicate_rows_are_dropped(self):
        self.assertEqual(self.run_script("""const table = full(10, 100, (i) => i);
            table.append(rows(10.5, 100, (i) => i));
            table.prepend(rows(9.5, 100, (i) => i));
            const times = [...table.rows(0, 100)].map((row) => row.time_s);
            return [length(table), times.every((time, i) => i === 0 || time > times[i - 1])];"""), [200, True])

    def test_value_at_a_time_is_the_latest_before_it(self):
        self.assertEqual(self.run_script("""const table = full(10, 100, (i) => i);
            return [table.at(9.99), table.at(10.005).v, table.at(99).v];"""), [None, 0, 99])

    def test_a_restarted_source_clears_the_store(self):
        self.assertEqual(self.run_script("""const store = new Store({ M: { v: {} } }, false);
            const batch = (from_s) => ({ newest_s: from_s + 0.99, nodes: { 1: { M: rows(from_s, 100, () => 1) } } });
            let begun = 0;
            store.addEventListener("restart", () => ++begun);
            store.append(batch(100));
            store.append(batch(5));
            return [begun, store.oldest_s, length(store.table(1, "M"))];"""), [1, 5, 100])

    def test_deviations_are_shown_while_the_estimator_reports_them(self):
        with_deviations, without_deviations, none = self.run_script("""const { Parameters } = await import("/parameters.js");
            const { protocol } = await (await fetch("/api/about")).json();
            const numbers = Object.fromEntries(Object.entries(protocol.Estimate.parameter.values).map(([n, name]) => [name, Number(n)]));
            const store = new Store(protocol, false);
            const parameters = new Parameters(1, store);
            const shown = () => { parameters.update(Infinity); return Object.fromEntries([...parameters.element.querySelectorAll("tbody tr")]
                .map((row) => [row.children[0].textContent, [...row.children].slice(1).map((cell) => cell.textContent)])); };
            let time_s = 0;
            const receive = (values, error_bound) => {
                for (const [name, value] of Object.entries(values)) {
                    const signal = { bias: "bias_W", bias_deviation: "bias_deviation_W", stiffness: "stiffness_N_per_m" }[name] ?? name;
                    const row = { time_s: [time_s += 0.1], parameter: [numbers[name]], trusted: [1], error_bound: [error_bound], [signal]: [value] };
                    store.append({ newest_s: time_s, nodes: { 1: { Estimate: row } } });
                }
                return shown();
            };
            const of_theta = { theta1: 18.8, theta2: 38.6, theta3: 322, theta4: 166, stiffness: 16 };
            const with_deviations = receive({ ...of_theta, bias: -0.0321, theta1_deviation: 0.5, theta2_deviation: 0.006, theta3_deviation: 1.5,
                theta4_deviation: 2.5, bias_deviation: 0.0004 }, 0.0123);
            for (let i = 0; i < 6; ++i) receive(of_theta, 0.2);
            const without_deviations = shown();
            return [with_deviations, without_deviations, receive({ theta1: null }, null)];""")
        self.assertEqual(with_deviations["θ1"], ["18.8", "m", "± 0.500", "± 1 %", "✓ trusted"])
        self.assertEqual(with_deviations["θ2"], ["38.6", "W·s²/m", "± 0.00600", "± 1 %", "✓ trusted"])
        self.assertEqual(with_deviations["θ3"], ["322", "W·s/m", "± 1.50", "± 1 %", "✓ trusted"])
        self.assertEqual(with_deviations["θ4"], ["166", "W/m", "± 2.50", "± 1 %", "✓ trusted"])
        self.assertEqual(with_deviations["bias"], ["−0.0321", "W", "± 4.00e−4", "–", "✓ trusted"])
        self.assertEqual(with_deviations["stiffness"], ["16.0", "N/m", "–", "± 1 %", "✓ trusted"])
        self.assertEqual(without_deviations["θ1"], ["18.8", "m", "–", "± 20 %", "✓ trusted"])
        self.assertEqual(without_deviations["bias"], ["–", "W", "–", "–", "–"])
        self.assertEqual(none["θ1"][:4], ["–", "m", "–", "–"])

    def test_another_protocol_version_is_reported(self):
        texts = self.run_script("""const { StateCard } = await import("/state_card.js");
            const { protocol } = await (await fetch("/api/about")).json();
            const store = new Store(protocol, false);
            const card = new StateCard(1, store, () => {}, 3);
            card.element.dataset = {};  // this document is an image
            const shown = (version) => {
                store.append({ newest_s: version, nodes: { 1: { Status: { time_s: [version], state: [0], protocol_version: [version] } } } });
                card.update(Infinity);
                return card.foreign.hidden || card.foreign.textContent;
            };
            return [shown(2), shown(3), shown(4)];""")
        self.assertEqual(texts[1], True)
        self.assertIn("version 2 of the protocol, this page 3", texts[0])
        self.assertIn("version 4 of the protocol, this page 3", texts[2])

    def test_a_fault_is_shown_with_its_margin_until_reset(self):
        texts = self.run_script(CARD + """const shown = (time_s, fault, more) => {
                const status = { time_s: [time_s], state: [3], fault: [fault], protocol_version: [protocol_version] };
                store.append({ newest_s: time_s, nodes: { 1: { Status: status, ...more } } });
                card.update(time_s);
                return card.fault.hidden ? "" : card.fault_button.textContent;
            };
            const emergency = (time_s, fault) => ({ time_s: [time_s], fault: [fault] });
            return [shown(1, 23, { Emergency: emergency(1, 23), FirstCause: { time_s: [1], measured: [0.0008], limit: [0.00267] } }),
                    shown(2, 23), shown(3, 0, { Emergency: emergency(3, 0) }), shown(4, 30, { Emergency: emergency(4, 30) })];""")
        with_margin = "fault 23: heater not responding (measured 8.00e−4, limit 0.00267 m) – what to do"
        self.assertEqual(texts, [with_margin, with_margin, "", "fault 30: over temperature – what to do"])

    def test_a_disabled_proof_of_response_is_shown(self):
        texts = self.run_script(CARD + """const shown = (time_s, row) => {
                store.append({ newest_s: time_s, nodes: { 1: { Status: { time_s: [time_s], state: [0], ...row } } } });
                card.update(time_s);
                return card.unproven.hidden || card.unproven.textContent;
            };
            return [shown(1, {}), shown(2, { proof_off: [0] }), shown(3, { proof_off: [1] })];""")
        self.assertEqual(texts[:2], [True, True])
        self.assertIn("proof of response (proof_of_response is false, or this muscle is one of a joint's two or follows in a bundle)", texts[2])

    def test_an_oscillated_loop_is_shown(self):
        texts = self.run_script(CARD + """const shown = (time_s, row) => {
                store.append({ newest_s: time_s, nodes: { 1: { Status: { time_s: [time_s], state: [0], ...row } } } });
                card.update(time_s);
                return card.oscillated.hidden || card.oscillated.textContent;
            };
            return [shown(1, {}), shown(2, { oscillated: [0] }), shown(3, { oscillated: [1] })];""")
        self.assertEqual(texts[:2], [True, True])
        self.assertIn("its feedback is slower now", texts[2])

    def test_a_slack_muscle_is_shown(self):
        texts = self.run_script(CARD + """const shown = (time_s, row) => {
                store.append({ newest_s: time_s, nodes: { 1: { Status: { time_s: [time_s], state: [0], ...row } } } });
                card.update(time_s);
                return card.slack.hidden || card.slack.textContent;
            };
            return [shown(1, {}), shown(2, { slack: [0] }), shown(3, { slack: [1] })];""")
        self.assertEqual(texts[:2], [True, True])
        self.assertIn("this muscle is slack at the present joint angle", texts[2])

    def test_every_reason_of_a_failed_identify_is_shown(self):
        texts = self.run_script(CARD + """const shown = (time_s, result, identify_notes, friction = 0) => {
                store.append({ newest_s: time_s, nodes: { 1: { Status: { time_s: [time_s], state: [0], result: [result], friction: [friction] },
                    Estimate: { time_s: [time_s], identify_notes: [identify_notes] } } } });
                card.update(time_s);
                return card.result.hidden || card.result.textContent;
            };
            return [shown(1, 0, 0), shown(2, 1, 0), shown(3, 2, 0), shown(4, 2, 1), shown(5, 6, 2 + 8 + 16), shown(6, 2, 16, 1)];""")
        last = "Last identify or calibrate: "
        self.assertEqual(texts, [
            True, True, last + "found: stored.", last + "found: stored; theta1 kept.",
            last + "poor fit: play; theta2 uncertain; theta4 uncertain.", last + "found: stored; poor fit; friction."])

    def test_shows_what_interrupted_identify(self):
        texts = self.run_script(CARD + """const values = (signal) => Object.entries(protocol.Status[signal].values);
            const number = (signal, name) => Number(values(signal).find(([, is]) => is === name)[0]);
            let time_s = 0;
            const shown = (result, state, fault = "none") => {
                ++time_s;
                store.append({ newest_s: time_s, nodes: { 1: { Status: { time_s: [time_s], state: [number("state", state)],
                    result: [number("result", result)], fault: [number("fault", fault)] } } } });
                card.update(time_s);
                return card.result.textContent.replace("Last identify or calibrate: ", "");
            };
            const texts = [];
            for (const [state, fault] of [["fault", "heater_open"], ["disarmed"], ["armed"]]) {
                shown("running", "active");
                texts.push(shown("interrupted", state, fault), shown("interrupted", "armed"));
            }
            card.result_before = card.by = "";
            return [...texts, shown("interrupted", "fault", "command_timeout")];""")
        self.assertEqual(texts, [*["interrupted by the fault heater open."] * 2, *["interrupted: it was disarmed."] * 2,
                                *["interrupted by another command."] * 2, "interrupted by a command or a fault."])

    def test_fault_pages_are_rendered_without_script(self):
        html = self.run_script("""const text = "# 30 a <b>\\n\\nTwo ways:\\n- one `x`\\n  more\\n- **two**\\n\\n1. [other](over_travel.md)\\n";
            const link = (label) => document.createTextNode(`(${label})`);
            return markdown(text, link).map((e) => e.outerHTML).join("");""")
        self.assertIn("30 a &lt;b&gt;", html)
        self.assertIn("<li>one <code>x</code> more</li>", html)
        self.assertIn("<li><strong>two</strong></li>", html)
        self.assertIn("<li>(other)</li>", html)


if __name__ == "__main__":
    unittest.main()
