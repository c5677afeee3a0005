"""The page says in words what happened in the time that it shows."""

import unittest

from modules import ModulesCase

OUTCOME = """const { cycle_text, infeasible_text, limits_text, never_armed_text, oscillation_text } = await import("/outcome.js");
    const { protocol, infeasible } = await (await fetch("/api/about")).json();
    const number = (message, signal, name) => Number(Object.entries(protocol[message][signal].values).find(([, is]) => is === name)[0]);
    const store = new Store(protocol, true);
    const receive = (message, from_s, count, period_s, row) => {
        const times = Array.from({ length: count }, (_, i) => from_s + i * period_s);
        const all = times.map(row);
        store.append({ newest_s: Math.max(times.at(-1), store.newest_s || 0), nodes: { 1: { [message]: { time_s: times,
            ...Object.fromEntries(Object.keys(all[0]).map((name) => [name, all.map((each) => each[name])])) } } } });
    };
    const state = (name, fault = 0) => ({ state: number("Status", "state", name), fault });
    const by = (name) => ({ limited_by: number("Power", "limited_by", name) });
    const range = { from_s: 0, to_s: 100 };
"""


class OutcomeTest(ModulesCase):
    def test_limits_are_a_fraction_of_the_heating_time(self):
        self.assertEqual(self.run_script(OUTCOME + """receive("Status", 0, 100, 0.1, (time) => state(time < 5 ? "armed" : "active"));
            receive("Power", 0, 500, 0.02, (time) => by(time < 5 ? "cooling" : time < 6 ? "maximum" : time < 6.5 ? "slew" : "nothing"));
            return [limits_text(store, 1, range), limits_text(store, 1, { from_s: 7, to_s: 10 }), limits_text(store, 2, range)];"""),
            ["At a limit in 30.0 % of the heating time: maximum 20.0 %, slew 10.0 %.", "", ""])

    def test_an_infeasible_reference_is_reported(self):
        self.assertEqual(self.run_script(OUTCOME + """const mode = (name) => ({ ...state("active"), mode: number("Status", "mode", name) });
            receive("Status", 0, 100, 0.1, (time) => mode(time < 5 ? "power" : time < 7 ? "position" : "joint"));
            receive("Power", 0, 500, 0.02, (time) => by(time < 5.5 ? "maximum" : time < 6 ? "cooling" : time < 8 ? "slew" : "nothing"));
            const text_of = (from_s, to_s) => infeasible_text(store, 1, { from_s, to_s }, infeasible);
            return [text_of(0, 100), text_of(5, 5.49), text_of(6.1, 10), text_of(0, 4)];"""),
            # A shaped reference says so: cooling.
            ["The reference asked for more than the muscle can do, for up to 0.980 s at a time and in 20.0 % of the time that it was followed: use a slower or smaller one.",
             "The reference asked for more than the muscle can do, for up to 0.480 s at a time and in 100.0 % of the time that it was followed: use a slower or smaller one, or shape_reference.", "", ""])

    def test_noise_at_a_limit_is_not_reported_as_infeasible(self):
        self.assertEqual(self.run_script(OUTCOME + """receive("Status", 0, 100, 0.1, () => ({ ...state("active"), mode: number("Status", "mode", "position") }));
            // 0.18 of each 0.2 s, then 0.22 of each 0.25 s.
            receive("Power", 0, 250, 0.02, (time) => by(Math.round(time / 0.02) % 10 < 9 ? "maximum" : "nothing"));
            const text_of = (from_s, to_s) => infeasible_text(store, 1, { from_s, to_s }, infeasible);
            const short = text_of(0, 4.99);
            receive("Power", 5, 250, 0.02, (time) => by(Math.round((time - 5) / 0.02) % 13 < 12 ? "maximum" : "nothing"));
            return [short, /in 9\\d\\.\\d % of the time/.test(text_of(5, 10))];"""), ["", True])

    def test_reports_why_it_was_never_armed(self):
        self.assertEqual(self.run_script(OUTCOME + """const texts = [never_armed_text(store, 1, range)];
            const note = () => texts.push(never_armed_text(store, 1, range));
            receive("Status", 0, 10, 0.1, () => state("disarmed")); note();
            const answered = (opcode, refusal) => () => ({ opcode: number("Acknowledge", "opcode", opcode), refusal: number("Acknowledge", "refusal", refusal) });
            (await import("/refusals.js")).take_refusals({ not_ready: "a probe is not over yet" });
            receive("Acknowledge", 2, 1, 1, answered("arm", "not_ready")); receive("Acknowledge", 3, 1, 1, answered("position", "wrong_state")); note();
            receive("Status", 4, 1, 0.1, () => state("fault", number("Status", "fault", "heater_open"))); note();
            receive("Status", 5, 1, 0.1, () => state("armed")); note();
            return texts;"""),
            ["", "Never armed: no arm command.", "Never armed: refused, not ready: a probe is not over yet.",
             "Never armed: fault 20, heater open.", ""])

    def test_an_oscillation_is_reported_with_its_period(self):
        self.assertEqual(self.run_script(OUTCOME + """let seed = 1;
            const noise = () => ((seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5) * 1e-5;
            receive("Tracking", 0, 1000, 0.01, () => ({ error_m: noise(), reference_m: 0.008 }));
            const texts = [oscillation_text(store, 1, { from_s: 0, to_s: 10 })];
            // It follows a sine: that is not by itself.
            receive("Tracking", 20, 2000, 0.01, (time) => ({ error_m: 1e-4 * Math.sin(Math.PI * time), reference_m: 0.008 + 0.002 * Math.sin(Math.PI * time) }));
            texts.push(oscillation_text(store, 1, { from_s: 20, to_s: 40 }));
            receive("Tracking", 50, 2000, 0.01, (time) => ({ error_m: 1e-4 * Math.sin(Math.PI * time) + noise(), reference_m: 0.008 }));
            return [...texts, oscillation_text(store, 1, { from_s: 40, to_s: 70 })];"""),
            ["", "", "It oscillates by itself: ± 100 µm with a period of 2.00 s, while the reference is constant."])

    def test_an_oscillation_under_a_moving_reference_is_reported(self):
        self.assertEqual(self.run_script(OUTCOME + """let seed = 1;
            const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
            receive("Status", 0, 900, 0.1, () => ({ ...state("active"), mode: number("Status", "mode", "position") }));
            const follow = (from_s, reference_s, limit) => {
                receive("Tracking", from_s, 1500, 0.02, (time) => ({ error_m: 1e-4 * Math.sin(40 * time), reference_m: 0.01 + 0.008 * Math.sin((2 * Math.PI * time) / reference_s) }));
                receive("Power", from_s, 1500, 0.02, (time) => by(limit(time)));
                return cycle_text(store, 1, { from_s, to_s: from_s + 29.9 });
            };
            const turning = (time) => (time % 0.5 < 0.2 ? "maximum" : time % 0.5 < 0.25 ? "nothing" : "minimum");
            const by_itself = follow(0, 6, turning);
            const as_asked = follow(30, 0.5, turning);
            const by_noise = follow(60, 6, () => (random() < 0.1 ? "maximum" : random() < 0.1 ? "minimum" : "nothing"));
            return [by_itself, as_asked, by_noise, cycle_text(store, 2, range)];"""),
            ["The loop oscillates with a period of 0.500 s while the reference moves: its power goes from one limit to the other. "
             "Lower its gains, or identify the muscle.", "", "", ""])


if __name__ == "__main__":
    unittest.main()
