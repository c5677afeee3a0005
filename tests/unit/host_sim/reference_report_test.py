"""What supercoil-sim run reports about the muscle and its reference before and after a run."""

import json
import re
import unittest

from sim_program import SHORT, ProgramCase

# The muscle may be cooled so badly that it holds only 12.1 mm.
HOT = "thermal = {transfer_ratio = [0.25, 2.2], power_ratio = [1.0, 1.3]}\n"


class ReferenceReport(ProgramCase):
    def after(self, text, status=0):
        """A run's output and its summary."""
        done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace", "--no-can")
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout, json.loads((self.path / "out/summary.json").read_text())

    def test_advises_shaping_for_a_muscle_slower_than_its_reference_model(self):
        slow = SHORT + "[plant]\nthermal_mass_J_per_K = 2.0\n"
        output = self.run_program("run", self.scenario(slow), "--check").stdout
        self.assertRegex(output, r"\nadvice: controller 0: .* shape_reference = true")
        shaped = slow + "[controller]\nshape_reference = true\n"
        self.assertNotIn("advice", self.run_program("run", self.scenario(shaped), "--check").stdout)

    def test_check_has_the_same_values_in_json_and_text(self):
        scenario = self.scenario(SHORT + "[controller]\nkind = 'learned_ff'\n[plant]\nthermal_mass_J_per_K = 2.0\n")
        report = json.loads(self.run_program("run", scenario, "--check", "--json").stdout)
        can, controller = report["feasibility"], report["feasibility"]["controllers"][0]
        text = self.run_program("run", scenario, "--check").stdout
        self.assertIn(f"holds {1e3 * can['travel_m']:.3g} mm indefinitely, at {can['held_W']:.3g} W", text)
        self.assertIn(f"margin {controller['margin']:.2g}, ", text)
        self.assertIn(f"bandwidth {controller['bandwidth_rad_per_s']:.3g} rad/s\n", text)
        self.assertIn(f"at most {1e6 * controller['promised_m']:.3g} um rms", text)
        self.assertEqual([line in text for line in report["advice"]], [True, True])
        self.assertEqual(report["reference"]["text"], re.search("\nreference: (.*)\n", text)[1])

    def test_a_reference_above_the_ceiling_is_reported(self):
        line = "reference: goes up to 20 mm, but the load cannot rise above plant.ceiling_m, 15 mm\n"
        low = SHORT + "plant.ceiling_m = 0.015\n"
        self.assertIn(line, self.run_program("run", self.scenario(low), "--check").stdout)
        report = json.loads(self.run_program("run", "s.toml", "--check", "--json").stdout)
        self.assertEqual(f"reference: {report['reference']['above_ceiling']}\n", line)
        later = SHORT + "[[event]]\nat_s = 1.0\nplant.ceiling_m = 0.015\n"
        self.assertIn("reference: from the event at 1 s on it goes up to 20 mm",
                      self.run_program("run", self.scenario(later), "--check").stdout)
        self.assertNotIn("ceiling", self.run_program("run", self.scenario(SHORT), "--check").stdout)

    def test_errors_of_small_muscles_have_three_digits(self):
        small = (SHORT + "plant.force_per_kelvin_N_per_K = 2e-6\n"
                 "sensor.position = {noise_rms_m = 1e-9, range_m = 1e-4}\n"
                 "reference = {offset_m = 8e-6, amplitude_m = 4e-6}\n")
        output, summary = self.after(small)
        rms_um, max_um = 1e6 * summary["tracking_rms_m"], 1e6 * summary["tracking_max_m"]
        self.assertLess(max_um, 10.0)
        self.assertIn(f"tracking error {rms_um:.3g} um rms, {max_um:.3g} um at most", output)

    def test_an_infeasible_reference_is_reported_with_its_ratio_and_advice(self):
        # Through a fast model even the step to the middle of the sine asks for too much.
        for turn_rad_per_s, shape, poles, infeasible in ((2.0, "false", [4.0, 5.0, 6.0], True), (2.0, "true", [4.0, 5.0, 6.0], True),
                                                       (0.2, "false", [4.0, 5.0, 6.0], True), (0.2, "false", [2.0, 2.0, 2.0], False)):
            text = (f"simulation.duration_s = 120.0\ncontroller = {{kind = 'learned_ff', shape_reference = {shape}}}\n"
                    f"reference.angular_frequency_rad_per_s = {turn_rad_per_s}\nreference_model.poles_rad_per_s = {poles}\n")
            done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace", "--no-can")
            ratio = json.loads((self.path / "out/summary.json").read_text())["infeasible_ratio"]
            self.assertEqual(ratio > 0.0, infeasible, (ratio, done.stdout))
            line = re.findall(r"asked for more than the muscle can do, first at .* s for .* s and in (.*) % of all ticks that followed it, "
                              r"mostly limited_by \w+: use a slower or smaller reference(.*)", done.stdout)
            advice = ", or shape_reference = true" if shape == "false" else ""
            self.assertEqual(line, [(f"{100 * ratio:.1f}", advice)] if infeasible else [])

    def test_a_suitable_controller_is_recommended_when_none_is_configured(self):
        scenario = self.scenario(SHORT)
        suits = json.loads(self.run_program("run", scenario, "--check", "--json").stdout)["feasibility"]["recommended"]
        self.assertIsNone(suits["in_use"])
        law = (f"{{ kind = \"{suits['kind']}\", shape_reference = {str(suits['shape_reference']).lower()}, "
               f"bandwidth_rad_per_s = {suits['bandwidth_rad_per_s']:.4g} }}")
        model = "{ kind = \"poles\", poles_rad_per_s = [" + ", ".join(f"{p:.4g}" for p in suits["model_poles_rad_per_s"]) + "] }"
        self.assertIn(f"\nrecommended: controller = {law}: {suits['reason']}\nrecommended: reference_model = {model}: {suits['model_reason']}\n",
                      self.run_program("run", scenario, "--check").stdout)
        taken = f"controller = {law}\nreference_model = {model}\n" + SHORT
        self.assertIn("\nrecommended: controller 0, as configured: it follows closest", self.after(taken)[0])
        self.assertEqual(json.loads(self.run_program("run", "s.toml", "--check", "--json").stdout)["feasibility"]["recommended"]["in_use"], 0)

    def test_noise_at_a_limit_is_not_an_infeasible_reference(self):
        output, summary = self.after("simulation.duration_s = 60.0\n")
        self.assertGreater(sum(summary["limited_by_ratio"].values()), 0.03)
        self.assertEqual((summary["infeasible_ratio"], summary["infeasible_from_s"]), (0, None))
        self.assertNotIn("asked for more", output)

    def test_a_reference_infeasible_after_an_event_is_reported_with_the_event(self):
        step = "reference = {kind = 'steps', levels_m = [0.010], hold_s = 50.0}\ncontroller.kind = 'pi'\n"
        output, summary = self.after(HOT + "simulation.duration_s = 40.0\n" + step + "[[event]]\nat_s = 15.0\nplant.load_N = 0.06\n", 1)
        self.assertGreater(summary["infeasible_from_s"], 15.0)
        self.assertIn(f"first at {summary['infeasible_from_s']:.1f} s for {summary['infeasible_lasts_s']:.3g} s and in "
                      f"{100 * summary['infeasible_ratio']:.1f} % of all ticks that followed it, after the event at 15 s (plant.load_N), mostly "
                      "limited_by temperature: use a smaller reference\n", output)

    def test_a_step_is_reported_alike_before_and_after_a_run(self):
        # At rest, noise keeps the power at its minimum for a while, which no reference asks for.
        step = ("simulation.duration_s = 60.0\nplant.thermal_mass_J_per_K = 2.0\n"
                "reference = {kind = 'step', from_m = 0.0, to_m = 0.02, at_s = 5.0}\n")
        before = json.loads(self.run_program("run", self.scenario(step), "--check", "--json").stdout)["reference"]
        _, summary = self.after(step, 1)
        self.assertLess(abs(summary["infeasible_from_s"] - before["first_s"]), 0.02)
        self.assertLess(abs(summary["infeasible_lasts_s"] / before["first_lasts_s"] - 1.0), 0.2)

    def test_a_fast_sine_attenuated_by_the_model_is_reported(self):
        quick = ("simulation.duration_s = 30.0\nreference = {kind = 'sine', offset_m = 0.011, amplitude_m = 0.009, angular_frequency_rad_per_s = 3.0}\n"
                 "controller = {kind = 'learned_ff', shape_reference = true}\n")
        text = self.run_program("run", self.scenario(quick), "--check").stdout
        before = json.loads(self.run_program("run", "s.toml", "--check", "--json").stdout)["reference"]
        self.assertLess(before["passed_ratio"], 0.05)
        self.assertGreater(before["passed_by_recommended_ratio"], 5 * before["passed_ratio"])
        line = re.search(r"\nreference: (the reference model passes .*)\n", text)[1]
        self.assertIn(f"passes {before['passed_ratio']:.3g} of its amplitude", line)
        self.assertIn(f"is {1e3 * before['off_reference_rms_m']:.3g} mm rms from the reference itself", line)
        self.assertIn(f"the recommended reference_model passes {before['passed_by_recommended_ratio']:.3g}", line)
        output, summary = self.after(quick)
        self.assertIn(f"\nit was {1e3 * summary['off_reference_rms_m']:.3g} mm rms from the reference itself: {line}\n", output)
        self.assertLess(abs(summary["off_reference_rms_m"] / before["off_reference_rms_m"] - 1.0), 0.2)
        self.assertLess(before["promised_rms_m"], 100e-6)
        usual = self.run_program("run", self.scenario(SHORT), "--check").stdout
        self.assertNotIn("reference model passes", usual)

    def test_shaping_is_not_advised_when_an_event_has_enabled_it(self):
        fast = "simulation.duration_s = 40.0\nreference.angular_frequency_rad_per_s = 2.0\ncontroller.kind = 'learned_ff'\n"
        fast += "reference_model.poles_rad_per_s = [4.0, 5.0, 6.0]\n"
        output, _ = self.after(fast + "[[event]]\nat_s = 0.0\ncontroller.shape_reference = true\n")
        self.assertRegex(output, r"after the event at 0 s \(controller\.shape_reference\), mostly limited_by \w+: use a slower or smaller reference\n")

    def test_a_set_point_beyond_the_held_travel_is_reported_with_its_fault(self):
        step = "simulation.duration_s = 200.0\nreference = {kind = 'step', to_m = 0.03, at_s = 5.0}\nsensor.position.min_m = -0.01\n"
        beyond = "; a set point that stays above %s mm %s\n"
        for shape, load_N, held_mm, end in (("false", 0.0, 25, True), ("true", 0.0, 25, False), ("true", 0.05, 21.9, True)):
            scenario = self.scenario(step + f"controller = {{kind = 'learned_ff', shape_reference = {shape}}}\nplant.load_N = {load_N}\n")
            text = self.run_program("run", scenario, "--check").stdout
            self.assertIn(beyond % (held_mm, "ends in controller_invalid after 120 s" if end else "comes back to it"), text)
            predicted_s = json.loads(self.run_program("run", scenario, "--check", "--json").stdout)["reference"]["controller_invalid_s"]
            self.assertEqual(f"; it ends in controller_invalid at about {predicted_s or 0:.3g} s" in text, end)
            summary = self.after((self.path / "s.toml").read_text(), 1 if end else 0)[1]
            self.assertEqual([fault["name"] for fault in summary["faults"]], ["controller_invalid"] if end else [])
            if end:
                self.assertLess(abs(summary["faults"][0]["at_s"] - predicted_s), 3.0)

    def test_a_possible_overtemperature_is_reported_in_advance(self):
        scenario = self.scenario(HOT + "reference = {kind = 'steps', levels_m = [0.018], hold_s = 50.0}\n")
        reference = json.loads(self.run_program("run", scenario, "--check", "--json").stdout)["reference"]
        self.assertEqual((reference["limited_by"], reference["held_by"]), ("temperature", "temperature"))
        self.assertIn(f"holds {1e3 * reference['held_m']:.3g} mm indefinitely (limited_by temperature)", reference["text"])
        self.assertGreater(reference["max_m"], reference["held_m"])


if __name__ == "__main__":
    unittest.main()
