"""What supercoil-sim run promises, what it finds afterwards, and that JSON has the same as the text."""

import json
import unittest

from sim_program import EXAMPLES, SHORT, ProgramCase

QUIET = ("--out", "out", "--no-plot", "--no-trace", "--no-can")
FOLLOWS = "controller.kind = 'learned_ff'\nsimulation.duration_s = 60.0\n"
WEAK = "simulation.duration_s = 60.0\ncontroller = {kind = 'pi', proportional_W_per_m = 20.0, integral_W_per_m_s = 1.0}\n"
IDENTIFIED = ("simulation.duration_s = 400.0\noperator.action = 'identify'\n"
              "event = [{at_s = 140.0, operator.action = 'track'}]\n")


class Outcome(ProgramCase):
    def run_of(self, text, *options):
        """A run's output and messages, its status, and its summary."""
        done = self.run_program("run", self.scenario(text), *QUIET, *options)
        return done, json.loads((self.path / "out/summary.json").read_text())

    def check(self, text):
        done = self.run_program("run", self.scenario(text), "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, json.loads(self.run_program("run", "s.toml", "--check", "--json").stdout)

    def test_run_starts_with_the_output_of_check(self):
        text = FOLLOWS + "power = {pwm_bits = 8, delay_s = 0.01}\nplant.load_N = 0.05\nsensor.position.min_m = -0.01\n"
        lines = self.check(text)[0].splitlines()[1:]
        for part in ("margin", "bandwidth", "may be armed", "PWM steps", "rests at -3.12 mm", "recommended: ", "reference: promised is at most"):
            self.assertIn(part, "\n".join(lines))
        self.assertEqual(self.run_of(text)[0].stdout.splitlines()[:len(lines)], lines)

    def test_a_run_that_tracks_is_compared_with_its_promise(self):
        output, before = self.check(FOLLOWS)
        done, summary = self.run_of(FOLLOWS)
        self.assertEqual((done.returncode, summary["did_not_follow_because"], summary["promised_by"]), (0, None, "own"), done.stderr)
        self.assertEqual(summary["promised_rms_m"], before["reference"]["promised_rms_m"])
        self.assertIn(f"promised: {1e6 * summary['promised_rms_m']:.1f} um rms, as the sensor shows it", done.stdout)

    def test_a_reference_that_the_board_refuses_is_reported_in_advance(self):
        beyond = SHORT + "reference = {kind = 'sine', offset_m = 0.02, amplitude_m = 0.015}\n"
        board = ("--board", EXAMPLES / "raspberry-pi-pwm-ads1115.toml")
        output = self.run_program("run", self.scenario(beyond), *board, "--check").stdout
        self.assertIn("\nreference: goes from 5 mm to 35 mm, but the board takes only 0 to 25 mm (limits.max_travel_m) and refuses all else, which ends in "
                      "command_timeout\n", output)
        self.assertNotIn("reference: the recommended controller promises", output)
        self.assertIn("fault 60 command_timeout", self.run_program("run", "s.toml", *board, *QUIET, "--allow-fault").stdout)
        within = self.check(SHORT)
        self.assertEqual(("refuses" in within[0], within[1]["reference"]["out_of_range"]), (False, ""))

    def test_a_motion_that_did_not_track_is_a_failure_with_its_reason(self):
        done, summary = self.run_of(WEAK)
        self.assertGreater(summary["tracking_rms_m"], 10 * summary["promised_rms_m"])
        self.assertEqual(done.returncode, 1)
        self.assertIn("it did not follow: " + summary["did_not_follow_because"], done.stderr)
        self.assertRegex(summary["did_not_follow_because"], r"mm rms from its reference model, for a motion of .* mm and a promise of .* mm: the ")
        done, _ = self.run_of(WEAK, "--allow-fault")
        self.assertEqual(done.returncode, 0)
        self.assertIn("it did not follow: ", done.stdout)

    def test_recommendation_and_promise_include_a_delay(self):
        output, before = self.check(FOLLOWS + "power.delay_s = 0.04\n")
        suits = before["feasibility"]["recommended"]
        self.assertLess(suits["bandwidth_rad_per_s"], 7.9)
        self.assertIsNone(suits["problem"])
        self.assertIn("with 41 ms of delay, more bandwidth would leave a margin below 0.4", output)
        late = self.check(FOLLOWS + "power.delay_s = 0.1\n")[0]
        self.assertIn("controller 0 promises no error (its margin is too small); the recommended one promises", late)
        self.assertIn("advice: its power acts 100 ms late, and a probe of the heater takes 50 ms: it ends in heater_open", late)
        self.assertIn("fault 20 heater_open", self.run_of(SHORT + "power.delay_s = 0.049\n", "--allow-fault")[0].stdout)
        self.assertEqual(self.run_of(SHORT + "power.delay_s = 0.048\n")[0].returncode, 0)
        self.assertEqual(["a probe" in self.check(SHORT + f"power.delay_s = {delay_s}\n")[0] for delay_s in (0.048, 0.049)], [False, True])
        # The recommended controller does what was promised.
        model = ", ".join(f"{p:.4g}" for p in suits["model_poles_rad_per_s"])
        taken = (f"simulation.duration_s = 60.0\npower.delay_s = 0.04\nreference_model = {{ kind = 'poles', poles_rad_per_s = [{model}] }}\n"
                 f"controller = {{ kind = 'learned_ff', shape_reference = true, bandwidth_rad_per_s = {suits['bandwidth_rad_per_s']:.4g} }}\n")
        _, before = self.check(taken)
        self.assertGreater(before["feasibility"]["controllers"][0]["margin"], 0.39)
        done, summary = self.run_of(taken)
        self.assertEqual((done.returncode, summary["oscillated_at_s"]), (0, None))
        self.assertLess(summary["tracking_rms_m"], summary["promised_rms_m"])

    def test_power_noise_is_reported_before_and_after_a_run(self):
        noisy = FOLLOWS + "sensor.position.noise_rms_m = 200e-6\n"
        output, before = self.check(noisy)
        swing_W = before["feasibility"]["controllers"][0]["noise_power_W"]
        self.assertIn("makes the power swing by", output)
        done, summary = self.run_of(noisy)
        self.assertIn("the controller's power swung by", done.stdout)
        self.assertLess(abs(summary["power_noise_W"] / swing_W - 1.0), 0.3, (summary["power_noise_W"], swing_W))
        # The advice does not lead away from the recommended controller.
        for text in (output, done.stdout):
            self.assertIn("a sensor with less noise reduces it", text)
            self.assertNotIn("lower gains", text)
        output, _ = self.check(noisy + "controller.bandwidth_rad_per_s = 12.0\n")
        self.assertIn("lower gains", output)
        output, before = self.check(FOLLOWS)
        self.assertNotIn("swing", output)
        self.assertNotIn("swung", self.run_of(FOLLOWS)[0].stdout)

    def test_an_oscillating_loop_does_not_blame_the_reference(self):
        text = "simulation.duration_s = 40.0\nplant.force_per_kelvin_N_per_K = 0.02\nmuscle.force_per_kelvin_N_per_K = 0.0086\ncontroller = {kind = 'pi', proportional_W_per_m = 4000.0, integral_W_per_m_s = 8000.0}\n"
        done, summary = self.run_of(text, "--allow-fault")
        self.assertIsNotNone(summary["oscillated_at_s"], done.stdout)
        self.assertEqual([summary[key] for key in ("infeasible_ratio", "infeasible_from_s", "infeasible_lasts_s")], [None] * 3)
        self.assertNotIn("the reference asked for more", done.stdout)

    def test_a_diverging_law_is_not_reported_as_an_infeasible_reference_or_noise(self):
        text = "simulation.duration_s = 40.0\npower.delay_s = 0.03\ncontroller = {kind = 'mrac', adaptation_scale = 100}\n"
        output, before = self.check(text)
        self.assertTrue(before["reference"]["feasible"])
        done, summary = self.run_of(text)
        self.assertEqual((done.returncode, summary["infeasible_ratio"], summary["infeasible_from_s"]), (1, 0, None))
        self.assertIn("the loop oscillated or diverged", summary["did_not_follow_because"])
        self.assertGreater(summary["unasked_limit_ratio"], 0.9)
        self.assertIn(f"its power was at a limit in {100 * summary['unasked_limit_ratio']:.1f} % of all ticks that followed", done.stdout)
        for other in ("asked for more", "power swung"):
            self.assertNotIn(other, done.stdout + done.stderr)

    def test_power_for_an_infeasible_reference_is_not_noise(self):
        done, summary = self.run_of("simulation.duration_s = 60.0\nplant.force_per_kelvin_N_per_K = 0.002\n", "--allow-fault")
        self.assertIn("the reference asked for more than the muscle can do", done.stdout)
        self.assertNotIn("power swung", done.stdout)
        # Only the power that was applied counts, not the kilowatts that a law demands.
        self.assertLess(summary["power_noise_W"] or 0.0, 2.25)

    def test_the_promise_is_shown_with_the_measured_error(self):
        done, summary = self.run_of(FOLLOWS)
        shown_m = summary["tracking_shown_rms_m"]
        # The sensor's own noise is 10 um.
        self.assertLess(abs(shown_m - (summary["tracking_rms_m"] ** 2 + 10e-6 ** 2) ** 0.5), 1e-6)
        self.assertIn(f"promised: {1e6 * summary['promised_rms_m']:.1f} um rms, as the sensor shows it; the sensor showed {1e6 * shown_m:.1f} um\n", done.stdout)

    def test_an_identified_muscle_that_saturates_is_a_fault_in_spite_of_dithers(self):
        for to_m, max_W in ((0.02, 3.0), (0.03, 4.5)):  # at the maximum power, and at derating
            done, summary = self.run_of(IDENTIFIED + f"power.max_W = {max_W}\ncontroller.kind = 'pi'\n"
                                        f"reference = {{kind = 'step', to_m = {to_m}}}\n", "--allow-fault")
            self.assertEqual([fault["name"] for fault in summary["faults"]], ["controller_invalid"])
            self.assertAlmostEqual(summary["faults"][0]["at_s"], 262, delta=5)

    def test_an_identified_muscle_holds_what_derating_leaves_it(self):
        model = "{kind = 'poles', poles_rad_per_s = [3.276, 3.276, 3.276]}"
        law = "controller = {kind = 'learned_ff', shape_reference = true}\nestimator.kind = 'least_squares'\n"
        done, summary = self.run_of(IDENTIFIED + law + f"reference_model = {model}\nreference = {{kind = 'step', to_m = 0.025}}\n")
        self.assertEqual((done.returncode, summary["faults"]), (0, []))
        self.assertLess(summary["tracking_rms_m"], 50e-6)
        self.assertLess(summary["off_reference_rms_m"], 3e-3)

    def test_a_sensor_without_a_reading_does_not_end_the_report(self):
        done, summary = self.run_of(FOLLOWS + "[[event]]\nat_s = 5.0\ninjected_fault.position_loose = true\n")
        self.assertIsNone(summary["tracking_shown_rms_m"])
        self.assertIn("as the sensor shows it; the sensor had no reading in some ticks\n", done.stdout)
        self.assertEqual(done.returncode, 1)
        self.assertIn("the run ended in fault 10 sensor_out_of_range", done.stderr)

    def test_a_failed_identify_is_a_failure_with_its_reason(self):
        weak = "simulation.duration_s = 300.0\noperator.action = 'identify'\nplant.force_per_kelvin_N_per_K = 2e-5\n"
        done, summary = self.run_of(weak)
        result_text = summary["mode_result"]["text"]
        self.assertEqual((done.returncode, summary["mode_result"]["result"]), (1, "too_little_motion"))
        self.assertIn("too_little_motion: the muscle moved by less than 1 % of its travel", result_text)
        self.assertEqual(result_text.count("too_little_motion"), 1)
        self.assertTrue(result_text.endswith("(see running in `supercoil-sim docs`)"))
        self.assertIn("the last identify or calibrate: " + result_text, done.stdout)
        self.assertIn("identify or calibrate found nothing: " + result_text, done.stderr)
        self.assertEqual(self.run_of(weak, "--allow-fault")[0].returncode, 0)
        done, summary = self.run_of("simulation.duration_s = 5.0\noperator.action = 'identify'\n")
        self.assertEqual((done.returncode, summary["mode_result"]["result"]), (1, "running"))
        self.assertIn("running: it has not ended yet; give it a longer simulation.duration_s", done.stderr)

    def test_a_fault_is_reported_with_the_measured_value(self):
        done, summary = self.run_of(SHORT + "injected_fault.heater_open = true\n", "--allow-fault")
        fault = summary["faults"][0]
        self.assertGreater(fault["limit"], fault["measured"])
        self.assertIn(f": 0 measured, limit {fault['limit']:.3g} A (see faults/heater_open in `supercoil-sim docs`)", fault["text"])
        self.assertIn(fault["text"] + "\n", done.stdout)

    def test_with_json_only_json_is_printed(self):
        done, summary = self.run_of(SHORT, "--json")
        self.assertEqual(json.loads(done.stdout), summary)
        nodes = self.run_program("run", "s.toml", *QUIET, "--nodes", "2", "--json")
        self.assertEqual([node["scenario"] for node in json.loads(nodes.stdout)], ["s, node 1", "s, node 2"])
        wrong = self.run_program("run", self.scenario("plant.stiffness_N_per_m = -1\n"), "--json")
        self.assertEqual((wrong.returncode, json.loads(wrong.stdout)["problems"][0]["key"]), (2, "plant.stiffness_N_per_m"))
        listed = json.loads(self.run_program("list", "--json").stdout)
        text = self.run_program("list").stdout
        for kind in ("scenarios", "controller_presets", "reference_models"):
            for entry in listed[kind]:
                self.assertIn(f"  {entry['name']:14} {entry['description']}\n", text)


if __name__ == "__main__":
    unittest.main()
