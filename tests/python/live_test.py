"""The package commands the simulated board, with asyncio and without."""

import asyncio
import concurrent.futures
import math
import time
import unittest

from patience import DEADLINE_S, QUICK, STARVED, TRIES, patient

import supercoil
from supercoil import Setting, State, messages, sync

TARGET_M = 0.0004  # a reference model takes its time


def position_is(muscle, position_m, tolerance_m=2e-4):
    return abs(muscle.position_m - position_m) <= tolerance_m


def learn():
    """It takes twelve seconds in real time."""
    with sync.Simulation(QUICK, deadline_s=30.0) as simulation:
        muscle = simulation.muscle
        muscle.arm()
        outcome = muscle.calibrate()
        try:
            muscle.identify(timeout_s=0.5)
        except supercoil.NotReachedError:
            return outcome, muscle.state
        return outcome, None


executor = concurrent.futures.ThreadPoolExecutor()


def setUpModule():
    global learned
    learned = executor.submit(learn)  # while the others run


def tearDownModule():
    executor.shutdown()


class OnOneBoard(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.simulation = sync.Simulation(QUICK)
        cls.simulation.start()
        cls.addClassCleanup(cls.simulation.stop)
        cls.address = cls.simulation.address
        cls.observer = cls.simulation.muscle  # never commands

    def observe(self, wanted):
        """Waits until what the board reports is as wanted."""
        end = time.monotonic() + DEADLINE_S
        while not wanted(self.observer):
            self.assertLess(time.monotonic(), end, "never seen")
            time.sleep(0.01)

    def muscle(self, **options):
        """Reset first where an earlier try left a fault."""
        muscle = sync.Muscle(self.address, **{"deadline_s": 30.0, **options})
        with muscle:
            if muscle.state == State.fault:
                muscle.reset()
        return muscle

    @patient
    def test_asynchronous_motion(self):
        self.muscle()

        async def experiment():
            async with supercoil.Muscle(self.address, node=1, deadline_s=30.0) as muscle:
                await muscle.arm()
                self.assertEqual((muscle.state, muscle.telemetry.status.probing), (State.armed, False))
                await muscle.move_to(TARGET_M)
                self.assertTrue(position_is(muscle, TARGET_M))
                powers_W = []
                for _ in range(6):  # together more than twice what a command lasts
                    await muscle.hold(0.1)
                    powers_W.append(muscle.telemetry.power.applied_W)
                self.assertEqual((muscle.state, muscle.telemetry.status.mode), (State.active, supercoil.Mode.position))
                self.assertGreater(max(powers_W), 0.01)  # the sensor's noise moves each of them
                self.assertEqual(muscle.telemetry.tracking.reference_m, TARGET_M)
        asyncio.run(experiment())
        self.observe(lambda m: m.state == State.disarmed and not m.telemetry.status.leased)

    @patient
    def test_synchronous_motion(self):
        self.muscle()
        with supercoil.Muscle(self.address, node=1, deadline_s=30.0) as muscle:
            muscle.arm()
            muscle.move_to(TARGET_M)
            muscle.hold(0.6)
            self.assertEqual(muscle.state, State.active)
            muscle.rest()
            muscle.rest()  # at rest already
            muscle.set_power(0.2)
            muscle.disarm()
        self.observe(lambda m: m.state == State.disarmed and not m.telemetry.status.leased)

    @patient
    def test_an_out_of_range_value_is_refused_with_the_nearest(self):
        with self.muscle() as muscle:
            muscle.arm()
            with self.assertRaises(supercoil.refusals.OutOfRange) as raised:
                muscle.set_position(1.0)
            self.assertAlmostEqual(raised.exception.nearest, 0.03996, 6)
            with self.assertRaises(supercoil.NotReachedError):
                muscle.move_to(0.0002, tolerance_m=1e-9, timeout_s=0.3)

    @patient
    def test_settings_are_read_and_changed(self):
        with self.muscle() as muscle:
            self.assertEqual(set(muscle.settings()), set(Setting))
            self.assertEqual(muscle.change(Setting.max_power_W, 2.0), 2.0)
            self.assertEqual(muscle.setting(Setting.max_power_W), 2.0)
            with self.assertRaises(supercoil.refusals.OutOfRange) as raised:
                muscle.change(Setting.max_power_W, 9.0)
            self.assertEqual(raised.exception.nearest, 4.5)
            self.assertEqual(muscle.change(Setting.max_power_W, 4.5), 4.5)
            quantities = muscle.quantities()
            self.assertEqual(quantities[supercoil.Quantity.stiffness_N_per_m], 16.0)
            self.assertTrue(math.isnan(quantities[supercoil.Quantity.unexplained_ratio]))

    @patient
    def test_a_running_controller_is_tuned(self):
        with self.muscle() as muscle:
            muscle.tune(base="configured")
            muscle.arm()
            muscle.set_position(TARGET_M)
            muscle.tune(proportional_W_per_m=1500, shape_reference=True)
            tuning = muscle.tuning()
            self.assertEqual(tuning["proportional_W_per_m"], (
                "proportional_W_per_m", "W/m", 1500.0, 2000.0, 2000.0, 1500.0, (0.0, 1e7)))
            self.assertEqual(tuning["shape_reference"][2:], (True, False, False, True, (False, True)))
            self.assertEqual(tuning["reference_model"].in_use, "design")
            self.assertNotIn("integral_W_per_m_s", tuning)
            self.assertEqual((muscle.state, muscle.telemetry.tracking.reference_m), (State.active, TARGET_M))
            muscle.store_tuning()
            muscle.prepare(kind="pi", integral_W_per_m_s=900)
            tuning = muscle.tuning()
            self.assertEqual(tuning["proportional_W_per_m"].stored, 1500.0)
            self.assertEqual(tuning["kind"][2:6], ("pd_ff", "pd_ff", "pd_ff", "pi"))
            self.assertEqual(tuning["integral_W_per_m_s"][2:6], (None, None, None, 900.0))
            muscle.take_over()
            self.assertEqual(muscle.tuning()["kind"].in_use, "pi")
            muscle.tune(base="configured")
            muscle.forget_tuning()
            for value in muscle.tuning().values():
                self.assertEqual(value[2:6], (value.configured,) * 4)
            self.assertEqual(muscle.state, State.active)

    @patient
    def test_an_estimator_is_tuned(self):
        with self.muscle() as muscle:
            before = muscle.tuning(estimator=0)
            self.assertEqual(before["kind"][2:], ("none",) * 4 + (("none", "gradient", "least_squares"),))
            muscle.tune(estimator=0, kind="least_squares", forgetting_s=20, trusted_error=0.1)
            tuning = muscle.tuning(estimator=0)
            self.assertEqual(tuning["forgetting_s"], ("forgetting_s", "s", 20.0, None, None, 20.0, (1.0, 3600.0)))
            self.assertEqual(tuning["trusted_error"].in_use, 0.1)
            self.assertNotIn("window_s", {name for name, value in tuning.items() if value.in_use is not None})
            muscle.tune(estimator=0, base="configured")
            self.assertEqual(muscle.tuning(estimator=0)["kind"].in_use, "none")
            for values, error, text in (
                    ({"bandwidth_rad_per_s": 1.0}, ValueError, "no value of an estimator is called"),
                    ({"kind": "pi"}, ValueError, "no kind is called 'pi'"),
                    ({"forgetting_s": 20}, supercoil.refusals.OutOfRange, "forgetting_s = 20 is refused"),
                    ({"controller": 1}, ValueError, "tune one of them")):
                with self.subTest(values), self.assertRaisesRegex(error, text):
                    muscle.tune(estimator=0, **values)
            with self.assertRaisesRegex(ValueError, "has no estimator 3"):
                muscle.tuning(estimator=3)

    @patient
    def test_unsuitable_values_are_refused_by_name(self):
        with self.muscle() as muscle:
            before = muscle.tuning()
            for values, error, text in (
                    ({"proportional_W_per_n": 1.0}, ValueError, "did you mean proportional_W_per_m?"),
                    ({"all": 1.0}, ValueError, "no value of a controller is called 'all'"),
                    ({"kind": "mrak"}, ValueError, "did you mean mrac?"),
                    ({"kind": 3}, ValueError, "kind = 3: must be one of power, pi"),
                    ({"learn": "yes"}, ValueError, "must be True or False"),
                    ({"follow_s": "1 s"}, ValueError, "must be a number"),
                    ({"base": "config"}, ValueError, "did you mean configured?"),
                    ({"follow_s": 0.1}, supercoil.refusals.OutOfRange, "follow_s = 0.1 is refused"),
                    ({"proportional_W_per_m": 1e9}, supercoil.refusals.OutOfRange, r"1e\+07 would be obeyed"),
                    ({"controller": 3}, supercoil.refusals.OutOfRange, "all = in_use is refused"),
                    ({"kind": "mrac", "reference_model": "eq8"}, supercoil.refusals.Unsuitable, "contradicts itself")):
                with self.subTest(values), self.assertRaisesRegex(error, text):
                    muscle.tune(**values)
            with self.assertRaisesRegex(ValueError, "has no controller 3"):
                muscle.tuning(3)
            after = muscle.tuning()
            self.assertEqual([after[name].in_use for name in before], [value.in_use for value in before.values()])

    @patient
    def test_a_missed_deadline_releases_the_muscle(self):
        with self.muscle(deadline_s=0.5) as muscle:
            muscle.arm()
            muscle.set_position(TARGET_M)
            self.observe(lambda m: m.state == State.active)
            self.observe(lambda m: m.state != State.active)
            if self.observer.fault != supercoil.Fault.none:
                muscle.hold(0.1)  # starved: raises
            self.observe(lambda m: not m.telemetry.status.leased)
            with self.assertRaisesRegex(supercoil.DeadlineError, "0.5 s"):
                muscle.set_position(TARGET_M)
            muscle.set_position(TARGET_M)
            self.observe(lambda m: not m.telemetry.status.leased)
        self.observe(lambda m: m.state == State.disarmed)

    def test_a_blocked_event_loop_causes_a_command_timeout(self):
        self.muscle()

        async def blocked():
            async with supercoil.Muscle(self.address, deadline_s=30.0) as muscle:
                await muscle.arm()
                await muscle.set_position(TARGET_M)
                time.sleep(0.6)  # noqa: ASYNC251
                await muscle.hold(DEADLINE_S)
        with self.assertRaises(supercoil.faults.CommandTimeout) as raised:
            asyncio.run(blocked())
        self.assertAlmostEqual(raised.exception.limit, 0.25, 6)
        self.assertGreater(raised.exception.measured, 0.25)
        self.assertEqual(self.observer.state, State.fault)
        with sync.Muscle(self.address, deadline_s=30.0) as muscle:
            with self.assertRaises(supercoil.faults.CommandTimeout):
                muscle.arm()
            muscle.reset()
            self.assertEqual((muscle.state, muscle.fault), (State.disarmed, supercoil.Fault.none))

    @patient
    def test_a_second_master_is_refused_and_may_stop(self):
        with self.muscle() as muscle:
            muscle.arm()
            with sync.Muscle(self.address.replace("socketcand:", "socketcand:127.0.0.1:")) as other:
                with self.assertRaises(supercoil.refusals.NotLeaseHolder):
                    other.arm()
                sync.stop(self.address.replace("socketcand:", "socketcand:localhost:"))
                self.observe(lambda m: m.state == State.disarmed)

    @patient
    def test_telemetry_as_objects_arrays_and_table(self):
        with self.muscle() as muscle:
            with muscle.record() as recording, muscle.record("Status", most_frames=3) as few:
                streamed = [message for message, _ in zip(muscle.stream(messages.Measurement), range(20), strict=False)]
            taken = list(recording.of(messages.Measurement))
            self.assertLessEqual(set(streamed), set(taken))
            arrays = recording.arrays("Measurement")
            self.assertEqual(list(arrays["position_m"]), [message.position_m for message in taken])
            table = recording.table("Measurement", "Status")
            self.assertEqual(list(table["Measurement.position_m"].dropna()), list(arrays["position_m"]))
            self.assertEqual(table.attrs["units"]["Measurement.position_m"], "m")
            self.assertEqual(set(table["Status.state"].dropna()), {"disarmed"})
            self.assertEqual({base for _, base, _ in few.frames}, {messages.STATUS})
            self.assertLessEqual(len(few.frames), 3)
            self.assertIn(supercoil.Parameter.theta4, self.observer.telemetry.estimates)
            self.assertRegex(muscle.program(), r"^\d+\.\d+\.\d+( \([0-9a-f]{7}\))?$")
            self.assertIn(supercoil.Gain.proportional, self.observer.telemetry.gains)
            self.assertIn(supercoil.Fault.over_temperature, self.observer.telemetry.margins)
            self.assertIn(supercoil.Fault.over_temperature, self.observer.telemetry.limits)

    def test_calibrate_returns_its_result_and_identify_can_be_interrupted(self):
        for attempt in range(TRIES):
            try:
                outcome, state = learned.result()
                break
            except STARVED:
                if attempt + 1 == TRIES:
                    raise
                setUpModule()
        self.assertEqual((outcome.result, state), (supercoil.Result.found, State.armed))

    def test_a_board_is_discovered(self):
        found, = sync.discover(self.address)
        self.assertEqual((found.node, found.protocol_version, found.can_be_commanded), (1, 5, True))


class OnSeparateBoards(unittest.TestCase):
    @patient
    def test_two_muscles_move_in_one_call(self):
        async def in_step():
            async with supercoil.Simulation(QUICK, deadline_s=30.0) as one, \
                    supercoil.Simulation(QUICK, deadline_s=30.0) as two:
                muscles = [one.muscle, two.muscle]
                for muscle in muscles:
                    await muscle.arm()
                for step in range(50):
                    measurements = await supercoil.cycle([muscle.make_position(step * 1e-5) for muscle in muscles])
                    await asyncio.sleep(0.02)
                self.assertEqual([type(message) for message in measurements], [messages.Measurement] * 2)
                await asyncio.gather(*(muscle.hold(0.2) for muscle in muscles))
                self.assertEqual([muscle.telemetry.tracking.reference_m for muscle in muscles], [0.00049] * 2)
                with self.assertRaises(supercoil.refusals.OutOfRange):
                    await supercoil.cycle([one.muscle.make_position(1.0), two.muscle.make_rest()])
                self.assertEqual(two.muscle.telemetry.newest(messages.Acknowledge).opcode.name, "rest")
        asyncio.run(in_step())

    def test_a_lost_bus_is_reported(self):
        simulation = sync.Simulation(QUICK).start()
        muscle = sync.Muscle(simulation.address)
        with self.assertRaises((supercoil.BusError, supercoil.NoAnswerError)), muscle:
            simulation.stop()
            while True:
                muscle.arm()

    def test_a_missing_scenario_is_named(self):
        with self.assertRaisesRegex(supercoil.SimulationError, "nowhere"), supercoil.Simulation("nowhere.toml"):
            pass


if __name__ == "__main__":
    unittest.main()
