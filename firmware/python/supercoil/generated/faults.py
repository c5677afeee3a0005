# Generated from docs/faults by toolchain/generate-can. Do not edit.

"""An exception for each fault, with the text of its page."""

from supercoil.errors import FaultError


class SensorOutOfRange(FaultError):
    """The position reading is a value that this sensor cannot give. The sensor's wire is disconnected, or shorted to a rail."""

    number = 10
    name = "sensor_out_of_range"
    meaning = """\
The position reading is a value that this sensor cannot give. The sensor's wire is disconnected, or shorted to a rail."""
    remedy = """\
1. Read the position while the muscle is cold. A value far beyond either end is a rail: check the cable.
2. Move the free end by hand. If the value follows, but is off, check scaling and mounting.
3. Reset, arm."""
    page = """\
# 10 sensor_out_of_range

The position reading is a value that this sensor cannot give. The sensor's wire is disconnected, or shorted to a rail.

**Detected** when the reading, scaled to metres but before the calibration of zero and scale, is below −2 mm or above
42 mm, or is NaN, for 5 ms without interruption (`position.min_m`, `position.max_m`, `out_of_range_ms`). A single
wild conversion does not trip.

**Reaction:** the channel goes cold.

During these 5 ms such a reading already counts as absent: nothing is computed from it, and the channel cannot be armed. It counts neither as travel nor
as a jump. The input must be pulled to a rail that lies outside the range.

## Likely causes

- the sensor's cable or plug
- the sensor has lost its supply
- a scaling (`m_per_count`, `offset_m`) that belongs to another sensor
- the sensor is mounted so that the muscle leaves its range

## Remedy

1. Read the position while the muscle is cold. A value far beyond either end is a rail: check the cable.
2. Move the free end by hand. If the value follows, but is off, check scaling and mounting.
3. Reset, arm.

## Margin

In metres: measured is the distance from the middle of the range (20 mm), the limit is half the range (22 mm).
A reading of 31 mm is 0.011 of 0.022, used 0.5. Used grows towards both ends. In normal work it stays below 0.91 over
0 to 40 mm; if it stays near 1 at rest, the sensor is at the end of its range.

## Not detected

- A broken wire on a board whose input has no pull: it floats, and may float inside the range
  ([wiring](../wiring.md)).
- A wrong value within the range. See [sensor_frozen](sensor_frozen.md) and
  [heater_not_responding](heater_not_responding.md).
- Any value while there is no fresh reading: then [sensor_stale](sensor_stale.md) trips first.
"""


class SensorStale(FaultError):
    """There is no fresh position, or no fresh current. The firmware never uses an old value instead."""

    number = 11
    name = "sensor_stale"
    meaning = """\
There is no fresh position, or no fresh current. The firmware never uses an old value instead."""
    remedy = """\
1. Find out which input it is: position_m or current_A of the row is empty.
2. Compare the converter's period with max_age_ms, which needs room for two periods and the time on the bus.
3. If both inputs of several channels fail at once, the cause is the bus.
4. Reset, arm."""
    page = """\
# 11 sensor_stale

There is no fresh position, or no fresh current. The firmware never uses an old value instead.

**Detected** at the first tick at which either is absent: the converter answers with an error, its newest conversion is
older than 10 ms (`max_age_ms` in the settings of each input), or its time lies in the future. So a converter that
falls silent is detected after 10 ms and a tick, and one that reports an error at once.

**Reaction:** the channel goes cold. In that tick no power is computed from the old position. If the current is missing, nothing proves that the
heat is off: 50 ms later [heater_stuck_on](heater_stuck_on.md) opens the supply of the board.

While the current is absent, the temperature estimate assumes any power between the set power and the channel's maximum power.

## Likely causes

- the bus thread of a buffered converter stalls, or its bus hangs
- a converter slower than `max_age_ms`
- if the fault is present from the start: a capture's trigger that does not run, or that has too many devices
  ([porting.md](../porting.md#a-trigger-for-iioscan))
- the driver was unbound, or the device unplugged: when it is back, it must be opened again, so restart supercoild
- conversions stamped by a clock other than the board's, so that they lie in the future

## Remedy

1. Find out which input it is: `position_m` or `current_A` of the row is empty.
2. Compare the converter's period with `max_age_ms`, which needs room for two periods and the time on the bus.
3. If both inputs of several channels fail at once, the cause is the bus.
4. Reset, arm.

## Margin

A flag: measured 0 is fresh, 1 is absent, the limit is 0. Used is 0 or infinite: there is no early warning. The age itself is not published.

## Not detected

- A driver that gives old values new times: [sensor_frozen](sensor_frozen.md) detects it, while hot.
- Another channel fault in the same tick, whose name is then hidden. A fault of the whole board is not hidden.
"""


class SensorFrozen(FaultError):
    """The position does not change at all; not even the noise of a working sensor is visible. The readings are new, so they are not stale, but
they repeat."""

    number = 12
    name = "sensor_frozen"
    meaning = """\
The position does not change at all; not even the noise of a working sensor is visible. The readings are new, so they are not stale, but
they repeat."""
    remedy = """\
1. Look at the value: a reading that equals position.min_m or max_m to the last digit is an end of the range. Look whether the muscle is whole;
   then move the sensor, or reduce the load.
2. Record one second of a working sensor at rest and compute its standard deviation. Put that, but at least a third of a converter step, into
   position.noise_rms_m.
3. If the sensor really shows no noise, set noise_rms_m to 0. The detector is then off, and you rely on
   heater_not_responding, which needs 20 s and more.
4. Otherwise restart the converter's driver. Reset, arm."""
    page = """\
# 12 sensor_frozen

The position does not change at all; not even the noise of a working sensor is visible. The readings are new, so they are not stale, but
they repeat.

**Detected** when, while the muscle is hot, all readings stay within ±5 µm of one of them for 1 s
(half of `position.noise_rms_m` = 10 µm; `frozen_s`). "Hot" means that the upper bound of the temperature estimate is
more than 5 K above the air, in every state. So the muscle counts as hot for 15 s after boot as well.

**Reaction:** the channel goes cold.

## Likely causes

- a driver or bus thread that repeats its last value
- a converter that hangs
- the position is at an end of the sensor's range, so that every reading is the end value: for example the muscle is torn, or a load pulls
  it longer than the sensor can measure
- a sensor that is quieter than `position.noise_rms_m`: a filter was added, or the noise was guessed

## Remedy

1. Look at the value: a reading that equals `position.min_m` or `max_m` to the last digit is an end of the range. Look whether the muscle is whole;
   then move the sensor, or reduce the load.
2. Record one second of a working sensor at rest and compute its standard deviation. Put that, but at least a third of a converter step, into
   `position.noise_rms_m`.
3. If the sensor really shows no noise, set `noise_rms_m` to 0. The detector is then off, and you rely on
   [heater_not_responding](heater_not_responding.md), which needs 20 s and more.
4. Otherwise restart the converter's driver. Reset, arm.

## Margin

In seconds: how long the readings have not changed while hot, of 1 s. A working sensor with the right noise stays below 0.02 s; used 0.3 means
that the sensor is much quieter than configured.

## Not detected

- A frozen sensor of a cold muscle, or below a steady power of about 0.21 W with the default bounds: there the upper bound stays below 5 K.
- A frozen sensor when `position.noise_rms_m` is 0.
- A frozen value that is replaced by a plausible, changing one.
"""


class SensorJump(FaultError):
    """The position changed more between two readings than any muscle can move."""

    number = 13
    name = "sensor_jump"
    meaning = """\
The position changed more between two readings than any muscle can move."""
    remedy = """\
1. Compare the position with what you see. If it is off by a constant, the sensor has slipped: fix it, calibrate.
2. If the load is meant to move that fast, raise max_speed_m_per_s.
3. Only then reset. The detector does not prevent a reset that is too early."""
    page = """\
# 13 sensor_jump

The position changed more between two readings than any muscle can move.

**Detected** when two consecutive fresh readings are further from the last good one than 0.5 m/s times the time since the previous reading, plus
0.17 mm (50 µm and 12 times the noise of 10 µm). At 1 kHz that is 0.67 mm. The first such reading is treated as a glitch, the second one trips
(`max_speed_m_per_s`, `position.noise_rms_m`). Readings outside the sensor's range do not count: they are
[sensor_out_of_range](sensor_out_of_range.md). The position is judged before zero and scale are applied, so a calibration does not count as a
jump.

**Reaction:** the channel goes cold. Then the detector accepts the new position: it no longer trips at the next reading, and a reset is not refused because
of it.

## Likely causes

- a loose plug, or a broken wire whose input floats inside the range
- the sensor slipped in its mounting, or was hit
- the load dropped: a real motion, faster than 0.5 m/s

## Remedy

1. Compare the position with what you see. If it is off by a constant, the sensor has slipped: fix it, `calibrate`.
2. If the load is meant to move that fast, raise `max_speed_m_per_s`.
3. Only then reset. The detector does not prevent a reset that is too early.

## Margin

In metres: the change, and the change allowed for the time between the readings. At rest some 30 µm of 670 µm, used 0.04. Values near 1 in
fast motion mean that `max_speed_m_per_s` leaves little margin.

## Not detected

- Drift, and jumps of less than 0.67 mm.
- Jumps that return before the next reading.
- Larger jumps with a slow converter: 5.2 mm is allowed at 100 Hz.
"""


class SensorsDisagree(FaultError):
    """The heater's resistance indicates one temperature and the position another."""

    number = 14
    name = "sensors_disagree"
    meaning = """\
The heater's resistance indicates one temperature and the position another."""
    remedy = """\
1. Let the muscle cool. When it is cold, both must indicate about 0 K; the one that does not is wrong.
2. If the position is wrong, find what holds the muscle, then calibrate. If the resistance is wrong, check crimps and plugs, then calibrate.
3. Reset, arm."""
    page = """\
# 14 sensors_disagree

The heater's resistance indicates one temperature and the position another.

**Off by default.** It is judged only if the resistance depends on temperature (`temperature_coefficient_per_K` above
0) and was measured within the last second. Silver-plated nylon may have no usable coefficient: measure it before you
switch this on.

**Detected** when the two temperatures differ by more than 30 K for 2 s (`disagree_K`, `disagree_s`):
- from resistance: (R / cold R − 1) / coefficient
- from position: position × stiffness / force per kelvin, that is, as if the muscle were at rest under its usual load. In a
  [joint](../joints.md) the motion by the other muscle's heat is subtracted, from `responding_ratio` times to 1/`responding_ratio` times what its models
  expect: of these temperatures the one nearest to that from resistance counts

**Reaction:** the channel goes cold.

## Likely causes

- the load changed, the muscle is caught on something, or its end slipped: the position is misleading
- a contact warms up or wears: the resistance is misleading
- a coefficient or a cold resistance that belongs to another muscle

## Remedy

1. Let the muscle cool. When it is cold, both must indicate about 0 K; the one that does not is wrong.
2. If the position is wrong, find what holds the muscle, then `calibrate`. If the resistance is wrong, check crimps and plugs, then `calibrate`.
3. Reset, arm.

## Margin

In kelvin: the difference, of 30 K. Example: resistance gives 42 K, position 30 K: 12 of 30, used 0.4.
While the fault is not judged, measured is 0.

## Not detected

- Any error without a coefficient, and while the duty is too small to measure a resistance.
- Small errors: with the paper's muscle 30 K is 16 mm of position, so only gross errors are detected.
- Errors of both in the same direction.
"""


class HeaterOpen(FaultError):
    """Duty is applied, but hardly any current flows."""

    number = 20
    name = "heater_open"
    meaning = """\
Duty is applied, but hardly any current flows."""
    remedy = """\
1. Switch the supply off. Measure the muscle's resistance at the board's terminals.
2. If it is right: is there voltage behind the supply switch while the heartbeat beats? If not, check fuse, pump and switch.
3. If there is, check sense and power switch.
4. If all channels have this fault at once, the cause is the supply switch.
5. Reset, arm. The probe at arming tests it again."""
    page = """\
# 20 heater_open

Duty is applied, but hardly any current flows.

**Detected** in one of two ways:
- The duty, averaged like the current sense, is at least 2 % and the current stays below a quarter of what a cold muscle
  would draw at the lowest supply, for 20 ms: 0.27 A times the duty for 10 Ω and 10.8 V (`open_min_duty`, `open_ms`).
- A probe, at arming or later, measured no current, or at least four times the cold resistance. The result is known after the
  probe's 50 ms.

**Reaction:** the channel goes cold.

## Likely causes

- a broken wire, crimp or plug of the muscle; the muscle itself has burned through
- no supply behind the switch: the charge pump does not pump, or a fuse has blown. The supply is measured before the
  switch and still looks good
- a failed power switch or gate
- the current sense reads 0

## Remedy

1. Switch the supply off. Measure the muscle's resistance at the board's terminals.
2. If it is right: is there voltage behind the supply switch while the heartbeat beats? If not, check fuse, pump and switch.
3. If there is, check sense and power switch.
4. If all channels have this fault at once, the cause is the supply switch.
5. Reset, arm. The probe at arming tests it again.

## Margin

In amperes, a minimum: the current, and its minimum at this duty. At a duty of 0.3, 0.36 A flows where 0.081 A is needed: used
0.22. A value closer to 1 means that the resistance has risen. Below a duty of 2 % the fault is not judged and used is 0, even if
the numbers look alarming.

## Not detected

- While the channel is off or its duty is below 2 %, except during probes.
- A resistance up to four times too high: that trips [resistance_drift](resistance_drift.md), at the next probe.
"""


class HeaterShort(FaultError):
    """More current flows than the muscle's minimum resistance allows."""

    number = 21
    name = "heater_short"
    meaning = """\
More current flows than the muscle's minimum resistance allows."""
    remedy = """\
1. If the board's fault is heater_stuck_on, continue on its page.
2. Switch the supply off. Measure the muscle's resistance; below 5 Ω it is shorted. Move it while measuring.
3. If the resistance is right, compare sense_filter_ms with the board's filter.
4. Reset, arm."""
    page = """\
# 21 heater_short

More current flows than the muscle's minimum resistance allows.

**Detected** when, while the channel is on, the current exceeds duty × supply / 5 Ω by more than 50 mA for 2 ms
(`min_resistance_Ohm`, `current.off_A`, `short_ms`). The duty is averaged with the time constant of the current sense, so that both refer to the
same time. Behind a bus this is true only to within a tick, because the duty takes effect, or the current is read, at any moment between two
ticks. There `short_ms` is at least two ticks, because after the end of a probe the current of the tick before exceeds the limit for one tick.

**Reaction:** the channel goes cold. The switch's own protection must be faster, because 2 ms is long for a transistor ([wiring](../wiring.md)).

## Likely causes

- turns of the muscle touch, or the muscle touches metal
- a wire is pinched
- **the power switch conducts by itself.** Full current then flows at a small duty, and first looks like a short.
  50 ms after the cut this becomes [heater_stuck_on](heater_stuck_on.md) for the board, while this channel keeps
  `heater_short` as its first cause
- `sense_filter_ms` does not match the sense: while the duty falls the current seems too high

## Remedy

1. If the board's fault is `heater_stuck_on`, continue on [its page](heater_stuck_on.md).
2. Switch the supply off. Measure the muscle's resistance; below 5 Ω it is shorted. Move it while measuring.
3. If the resistance is right, compare `sense_filter_ms` with the board's filter.
4. Reset, arm.

## Margin

In amperes: the current beyond that through the lowest resistance, of 0.05 A. Normally it is negative: 0.36 A at a duty of 0.3 and 12 V is
0.36 − 0.72 = −0.36, used −7.2. A positive value is already part of the 50 mA.

## Not detected

- A resistance between 5 Ω and the right one. [resistance_drift](resistance_drift.md) detects it at the next probe.
- Current while the channel is off: that is heater_stuck_on.
- A short past the sense, which does not measure that current.
"""


class HeaterStuckOn(FaultError):
    """Current flows although the channel is off. The only fault that software alone cannot cure: the power switch conducts by
itself, or its drive keeps it on. So the heartbeat stops and the charge pump opens the supply of the whole board."""

    number = 22
    name = "heater_stuck_on"
    meaning = """\
Current flows although the channel is off. The only fault that software alone cannot cure: the power switch conducts by
itself, or its drive keeps it on. So the heartbeat stops and the charge pump opens the supply of the whole board."""
    remedy = """\
1. Leave it off. Do not try a reset first: the supply is open, so there is no current and the reset is accepted. It
   starts the self-test, which closes the supply; a stuck switch then heats at full power for
   some 30 ms, until the test has failed: 2.5 K in a simulation. After that no reset helps, only a restart.
2. Switch the supply off. Measure the power switch: drain to source must not conduct.
3. If the switch is good, what does the sense read with the muscle unplugged? Check its offset and filter.
4. Replace the switch. Then reset or restart: either way the self-test must prove both cuts before anything can be armed."""
    page = """\
# 22 heater_stuck_on

Current flows although the channel is off. **The only fault that software alone cannot cure**: the power switch conducts by
itself, or its drive keeps it on. So the heartbeat stops and the charge pump opens the supply of the whole board.

**Detected** when the duty is 0 or the enable line low, and the current is above 50 mA, NaN, or not read at all, for 50 ms without
interruption (`current.off_A`, `stuck_on_ms`). Without a reading nothing proves that the heat is off. Only the current is proof;
the PWM's read-back is not, because it may be the kernel's memory. At the end of these 50 ms the current must also be more than an
averaging sense (`sense_filter_ms`) can still show of the earlier current, with a reserve of a quarter in the time constant: 32 mA
after 50 ms at 100 Hz, for 0.67 A and 10 ms. So a leak of little more than 50 mA may be detected a few time constants later; a
stuck switch is detected in time.

**Reaction:** every channel cold, heartbeat off, whatever other fault the channel has. If another fault was first, the
channel keeps that cause; the other channels show this one. With the default decay of 20 ms the supply is open about 70
ms after the switch stuck. The simulated muscle of 10 Ω at 12 V warms by 5.4 K in that time.

## Likely causes

- no current reading: a converter, its bus, its cable ([sensor_stale](sensor_stale.md) comes first)
- the power transistor failed short, as most do
- the gate driver or the enable gate failed
- the sense has an offset of more than 50 mA, or its filter is slower than `sense_filter_ms` says

## Remedy

1. Leave it off. **Do not try a reset first:** the supply is open, so there is no current and the reset is accepted. It
   starts the [self-test](self_test_failed.md), which closes the supply; a stuck switch then heats at full power for
   some 30 ms, until the test has failed: 2.5 K in a simulation. After that no reset helps, only a restart.
2. Switch the supply off. Measure the power switch: drain to source must not conduct.
3. If the switch is good, what does the sense read with the muscle unplugged? Check its offset and filter.
4. Replace the switch. Then reset or restart: either way the self-test must prove both cuts before anything can be armed.

## Margin

In amperes: the current while off, of 0.05 A; infinite without a reading. Used 0.1 to 0.3 is an offset. While the
channel is on, this fault is not judged.

## Not detected

- Leaks of less than 50 mA: 0.6 W at 12 V, which warms the paper's muscle permanently by some 7 K. The estimate counts them from
  10 mA on.
- Current past the sense, or a sense that reads too little.
- A stuck switch while the channel is on: [heater_short](heater_short.md) or [power_limit_exceeded](power_limit_exceeded.md) must
  detect it first.
"""


class HeaterNotResponding(FaultError):
    """Power goes in, current flows, and the position does not move as it should: 'moved 0.3 of the 2.0 mm expected in 20 s'."""

    number = 23
    name = "heater_not_responding"
    meaning = """\
Power goes in, current flows, and the position does not move as it should: 'moved 0.3 of the 2.0 mm expected in 20 s'."""
    remedy = """\
1. Do not look for the cause by heating more. Let the muscle cool.
2. Pull the free end: does the sensor follow?
3. Is the muscle straight, free, and still elastic? A muscle that has melted is stiff.
4. If nothing is wrong: identify, and compare with the configuration.
5. Reset, arm."""
    page = """\
# 23 heater_not_responding

Power goes in, current flows, and the position does not move as it should: "moved 0.3 of the 2.0 mm expected in 20 s".

**Detected** at the end of each window of 20 s, which compares the range of the position, from its minimum to its maximum, with that of ten
models of the muscle. It trips if each model moved by at least 1 mm, and the position by less than 0.3 of the model that moved least
(`responding_window_s`, `responding_ratio`, `responding_min_m`).

- One model is the believed muscle: configured, or found by the last `identify`. The other nine are mixtures of the fastest and the slowest muscle that
  its `[thermal]` bounds allow. So if some muscle within the bounds could stand still, no motion is expected.
- The models are driven with the applied power. Their motion in the last second of the window does not count, because they model heat but no inertia.
- Windows follow each other from boot on, or from an `identify` that found a muscle, whether the channel is armed or not, so detection takes 20 to 40 s.
  Neither arming nor a calibration restarts a window. A response (below) does not change the end of the window, but the expected and measured motion
  before the response no longer counts.

**A muscle that was identified must also respond while it is hot and still** (in mode position or power; a muscle from a learned file counts as
identified, unless the file has the configuration's own parameters). This is decided within seconds:

1. The safe power is the one at which even a quarter of the lowest heat transfer (`min_transfer_W_per_K`) keeps the muscle below derating: 1.1 W by
   default, and 0.61 W until the senses have been [compared with a meter](../safety.md#power), because 12 V may be 10.8 to 13.2 V until then. Above the
   safe power any motion that follows the power proves the muscle. The motion is compared with a model driven by the power that really acted.
2. If there is no such motion, a *dither* is added: a square wave of power (132 mW with halves of 0.2 s on the paper's muscle) whose response is at most
   20 µm, or two counts of a coarse sensor. The expected response is the one that [identify](../control.md#identify) measured: if friction leaves a
   quarter of the model's motion, the dither has four times the power, up to a tenth of `max_W`. (In simulation, friction of 0.2 % of the load leaves
   0.17 on the paper's muscle, and 1 % less than 0.01.) A muscle that the dither cannot move enough is limited to the safe power, and `--check` says so.
   A half lasts 1.2 s at most; that of a slow muscle up to 6 s, if no shorter one is decided in time and the muscle would move by at most 80 µm (or
   eight counts) if friction let it go. The dither begins early enough to be decided within half of the time in which a muscle at the interval's hot
   end, with its maximum power, the lowest mass and a quarter of the lowest heat transfer, reaches `trip_C`. Half of that time is 0.6 s if 4.5 W were
   held, and 1.7 s if 1.7 W were. (A muscle of 2 J/K has 7 s if 4.5 W were held and the senses were compared with a meter, and 2.8 s at the 2.8 W that
   it may have until then.) Nothing from before the dither is used. Near a limit (maximum, temperature, unproven) the demand makes room for both
   halves: the muscle holds its position with that much less, 24.7 instead of 25 mm on the paper's muscle at derating. Such a demand counts as
   limited, for controllers and for [controller_invalid](controller_invalid.md).
3. If there is no response, the power is taken away (limited by: `unproven`), and an intact muscle must now fall. If the position has fallen by less than
   0.17 of the model's fall when the model has fallen by twice `responding_min_m`, or after 3 s, the fault trips. A muscle that falls is intact, and
   friction or hysteresis hides its response to the dither: from then on only its own motion proves it. If its motion does not prove it within three
   quarters of the time in 2., for example because it is at rest, it gets at most the safe power until it rests or is disarmed, and then until it
   responds or must have cooled (below).
4. If nothing is decided within three quarters of that time (the sensor is noisier than `position.noise_rms_m`), the channel gets at most the safe power
   until there is a response. Then a missing response counts only after a motion or a time as in 3., because hysteresis hides the beginning of a motion
   that reverses. The dither goes on at the safe power, so that a muscle at rest can respond. A position that moves by more than 0.1 of
   `responding_min_m` rms in a block, for any reason, is unlikely to come from a dead sensor: the decision waits, but no longer than 5. allows.
5. Neither a rest, nor less power, nor arming again restores time that was used without a response. From each response on, the firmware computes the
   maximum temperature of a muscle that lost contact at that moment and has had a quarter of the lowest heat transfer since, with the power that really
   acted, also at rest. The shares of the time to the limit in 2. to 4. are used up by the clock, which restarts after any moment of less power and
   while the position moves by itself (4.), or by that heat, whichever comes first. So a muscle that was at the safe power for long has less time when it
   is given more. A muscle that was limited to the safe power, or whose power was taken away, gets the safe power after a rest until it responds (at rest
   its fall is a response), or until there is again enough time to decide a dither: at rest, 8 s on the paper's muscle.

| | |
|---|---|
| decision | a matched filter: Σ expected·measured / Σ expected², both high-pass filtered at 1 rad/s (for all power) or 4 rad/s (for the dither; lower if its halves are longer than 1.2 s), when the expected motion is 18.6 standard deviations of this ratio's noise |
| noise | `position.noise_rms_m` and the counts, or the motion that the model does not explain, whichever is larger |
| dead below | a ratio of 0.17: 3.1 standard deviations, so 1 dead muscle of 1000 passes a block |
| false alarm | if an intact muscle's response is half of the model's, less than once in 10⁹ blocks (6.2 standard deviations; counted up to 4, where it is at most twice a normal tail) |

An identified muscle never gets more power than the proof can keep up with: a lost contact must always be found before the limit. That power falls with
the noise, with slow ticks, and with how much the true power may exceed the measured one. So it rises at once when the senses are compared with a meter:
on a Raspberry Pi at 100 Hz (`raspberry-pi-pwm-ads1115.toml`) from 2.27 to 4.24 W. `supercoild --check` names the channel and the power.

`proof_of_response = false` in `[channel.detectors]` switches all of this off. Then only the window of 20 s remains, as for a muscle that is not
identified: its parameters may be wrong by half, and such a sensitive test would mistake it for a dead one. The muscles of a
[bundle](../joints.md#with-a-heater-each) are dithered together and respond together: a dead muscle is not detected beside intact ones.

**Reaction:** the channel goes cold. The next window begins; a reset is not refused because of this fault.

## Likely causes

- the muscle came off its anchor, or its end off the sensor
- the muscle is blocked, or its turns have melted together
- the heat flows elsewhere: the muscle lies in water, in moving air, against metal
- the believed parameters are far from this muscle (more than three times)
- the sensor is frozen at the position of a cold muscle

## Remedy

1. Do not look for the cause by heating more. Let the muscle cool.
2. Pull the free end: does the sensor follow?
3. Is the muscle straight, free, and still elastic? A muscle that has melted is stiff.
4. If nothing is wrong: `identify`, and compare with the configuration.
5. Reset, arm.

## Margin

In metres, a minimum: the range of the position in this window, and 0.3 of the range of the model that moved least. If the muscle moved 8 mm where 9 mm
were expected, the margin is 0.008 over 0.0027, used 0.34. Early in a window both are small; read the margin late. If less than 1 mm is expected, used
is 0. After a dither without a response: how far the muscle fell with the power, and 0.17 of what the model fell.

## Not detected

- A muscle that is not identified and is held at a constant power: once it is at rest, no motion is expected, so a sensor that slips off is not noticed.
  The same holds during identify, and with `proof_of_response = false`.
- For a muscle that is not identified any motion counts, in any direction and from any cause: a swinging load hides a dead muscle.
- On a muscle that is not identified: anything within the first 20 s. At 4.5 W it has reached its final temperature long before.

## False alarms

- **A sudden draught**, in which the controller holds the muscle still with more power: no model with constant cooling stands still then. Simulated with
  the paper's muscle, 10 µm of noise, `pi` and `learned_ff`: a muscle that is not identified trips when its cooling grows by half at 5 mm, or by 30 % at
  10 mm (each in all 6 runs), but not by 30 or 20 % (none of 12; 29 November 2026). An identified one does not trip at 3, 5 or 10 mm (none of 36), because its responses prove that it is intact;
  before responses counted, 16 did. It may still trip if its cooling grows by a factor of 2.2, the largest that `[thermal]` allows by default (17 of
  96): at 3 mm, from 0.4 to 0.9 W, and at other positions if the draught begins 2 to 3 s before a window ends. The muscles of a [joint](../joints.md),
  and those that follow in a bundle, have no responses of their own.
- **Believed cooling that is wrong by a factor of two**, while the power falls slowly and the muscle is still warming: no model stands still, but the
  muscle does (1 of 75 groups of 20 runs, [safety](../safety.md#what-narrows-the-interval)).
"""


class DutyWrong(FaultError):
    """The PWM does not apply the duty that was set: it refuses the duty, or reads back another one."""

    number = 24
    name = "duty_wrong"
    meaning = """\
The PWM does not apply the duty that was set: it refuses the duty, or reads back another one."""
    remedy = """\
1. Look at the margin. About 10⁹ (2³⁰) stands for a refused write: check bus and chip.
2. A difference of a few steps that follows the duty means that the read-back lags.
3. With any other difference, find out which other program has the device open.
4. Check that no current flows. Only the current shows whether the enable line has worked.
5. Reset, arm."""
    page = """\
# 24 duty_wrong

The PWM does not apply the duty that was set: it refuses the duty, or reads back another one.

**Detected** when, for 5 ms, the last write was answered with an error, or the step that is read back differs from the
step that was set (`wrong_duty_ms`). A device that cannot be read back, or not while a write is under way (it answers
with a negative number), is judged only by its errors. A failed write is tried again at each tick.

**Reaction:** the channel goes cold: duty 0 is written, which may fail as well, and the enable line goes low. In this
fault the enable line is the cut that matters.

## Likely causes

- the bus of an external PWM chip hangs, or the chip lost its supply
- another program writes to the same PWM
- a PWM behind a bus whose read-back lags: while the duty changes at each tick, the two are never equal. Such a driver
  must answer that it cannot be read while its write is under way

## Remedy

1. Look at the margin. About 10⁹ (2³⁰) stands for a refused write: check bus and chip.
2. A difference of a few steps that follows the duty means that the read-back lags.
3. With any other difference, find out which other program has the device open.
4. Check that no current flows. Only the current shows whether the enable line has worked.
5. Reset, arm.

## Margin

In steps of the PWM: the difference between the step that is read back and the step that was set; the limit is 0. Used
is 0 if they are equal, otherwise infinite.

## Not detected

- A read-back that is only the driver's memory of the set value (sysfs): it always agrees, whatever the pin does.
- A wrong period or polarity.
- A PWM behind a bus whose duty changes at each tick: a write is always under way, and only its errors are judged.

If the enable line fails as well, the current continues, and 50 ms later [heater_stuck_on](heater_stuck_on.md) opens
the supply.
"""


class LineFailed(FaultError):
    """An enable line or the heartbeat could not be set: the driver answered with an error. Both cuts depend on these lines,
so each of them must be certain to work."""

    number = 25
    name = "line_failed"
    meaning = """\
An enable line or the heartbeat could not be set: the driver answered with an error. Both cuts depend on these lines,
so each of them must be certain to work."""
    remedy = """\
1. Stop the firmware. Set each line by hand and measure at the gate and at the pump's input.
2. Find out which program holds the lines.
3. Start the firmware, or reset each channel: a failed line is tried again at each tick, the heartbeat without an
   edge, so the reset works when all lines obey. The self-test follows."""
    page = """\
# 25 line_failed

An enable line or the heartbeat could not be set: the driver answered with an error. Both cuts depend on these lines,
so each of them must be certain to work.

**Detected** at the tick after the failed write; a single failure is enough.

**Reaction:** every channel cold, as far as its lines obey, and the heartbeat stops. If an enable line failed, the charge pump cuts the supply.

## Likely causes

- the line is held by another program, or was released
- the GPIO chip has disappeared: unloaded driver, expander on a bus
- missing permissions

## Remedy

1. Stop the firmware. Set each line by hand and measure at the gate and at the pump's input.
2. Find out which program holds the lines.
3. Start the firmware, or reset each channel: a failed line is tried again at each tick, the heartbeat without an
   edge, so the reset works when all lines obey. The self-test follows.

## Margin

A flag: 0 good, 1 failed, the limit is 0.

## Not detected

- A line that is set without an error but does not reach its gate: a broken track, a wrong pin. The
  [self-test](self_test_failed.md) finds an enable line that does not cut, and a missing heartbeat shows as
  [heater_open](heater_open.md) on every channel when it is armed.
- A line that is not written at the time: enable lines are written only when their level changes.
- The status light. Its errors are ignored.
"""


class OverTemperature(FaultError):
    """The muscle may be hotter than allowed. Its temperature is not measured: the fault judges the upper end of an estimated interval
(safety)."""

    number = 30
    name = "over_temperature"
    meaning = """\
The muscle may be hotter than allowed. Its temperature is not measured: the fault judges the upper end of an estimated interval
(safety)."""
    remedy = """\
1. Compare the applied power with supply × current. If more is measured, see heater_stuck_on.
2. Otherwise let the muscle cool. The reset is refused until the estimate has fallen below the limit; it falls with the slowest time
   constant that the bounds allow, 4.4 s.
3. If the muscle was really too hot, inspect it: permanently shortened, stiff, discoloured?
4. Change bounds only on the basis of a measurement."""
    page = """\
# 30 over_temperature

The muscle may be hotter than allowed. Its temperature is not measured: the fault judges the upper end of an estimated interval
([safety](../safety.md#temperature)).

**Detected** at once when the upper bound of the muscle's temperature is above 160 °C (`trip_C`), or is NaN. After boot the fault is judged only
once the bound has been below the derating temperature. The bound is the warmest air (25 °C) plus the larger of two rises: that of the interval
observer with the configured bounds, and that of the observer with learned values. Both are driven by the larger of the set power and the measured
power.

**Reaction:** the channel goes cold. Well before that, from 130 °C on, the power is derated (limited by: temperature), to zero at 160 °C.

## Likely causes

- a switch that conducts by itself: measured power far above the set power
- a `max_W` that is too large for the bounds: in steady state the rise is at most max_W × 1.05 / 0.045 W/K, 105 K for 4.5 W, once the senses
  have been compared

## Remedy

1. Compare the applied power with supply × current. If more is measured, see [heater_stuck_on](heater_stuck_on.md).
2. Otherwise let the muscle cool. The reset is refused until the estimate has fallen below the limit; it falls with the slowest time
   constant that the bounds allow, 4.4 s.
3. If the muscle was really too hot, inspect it: permanently shortened, stiff, discoloured?
4. Change bounds only on the basis of a measurement.

## Margin

In °C: the upper bound, of 160 °C. 112 of 160 is used 0.70 (a ratio of degrees Celsius, not of rises). With the default bounds, compared senses,
4.5 W and a working switch it settles at 130 °C, used 0.81.

## Not detected

- Bounds that are wrong: another muscle, another medium, a blanket over it, air warmer than 25 °C.
- A hot spot: the estimate is for the whole muscle.
- Power that exceeds the set power by less than 10 mA × supply + 5 % (0.12 W while off): it is taken for the sense's error.
- The time from boot until the estimate falls below 130 °C, 1.1 s: how hot the muscle was before is unknown, and nothing
  can be armed.
"""


class OverTravel(FaultError):
    """The muscle has contracted further than allowed."""

    number = 31
    name = "over_travel"
    meaning = """\
The muscle has contracted further than allowed."""
    remedy = """\
1. Is the muscle really that short? If not, check sensor, zero and scale.
2. A reset is refused until the position is back below the limit. A muscle that has lost its load may have to be pulled back.
3. Look at the recording before the fault: a slope means that the muscle moved, a single point is a wrong reading of the sensor.
4. Reset, arm."""
    page = """\
# 31 over_travel

The muscle has contracted further than allowed.

**Detected** at once, by a single reading: the calibrated position is above 35 mm (`max_travel_m` of the channel), or is NaN. (In a scenario without a board's file that is 0.999 of the position sensor's range: 39.96 mm of 40.)
Readings outside the sensor's range do not count: they are [sensor_out_of_range](sensor_out_of_range.md). A position command beyond the limit is
refused (out of range). One at the limit is obeyed, but the sensor's noise or a small overshoot then trips this fault: set `max_travel_m` a
little beyond the farthest set point.

**Reaction:** the channel goes cold.

## Likely causes

- a command `power`, which does not stop at any position
- overshoot of a badly tuned controller
- the load fell off, or broke
- in a joint: the muscle on the other side is torn, or its cable is slack (below 0 the agonist's, above 0 the antagonist's); the fault
  occurs within 0.1 s, after a motion that no heat caused
- a wrong zero or scale: `scale` with the wrong length, `calibrate` while the muscle is caught on something
- one wild reading between `max_travel_m` and the end of the sensor's range: a single reading is enough here, unlike for [sensor_jump](sensor_jump.md)

## Remedy

1. Is the muscle really that short? If not, check sensor, zero and scale.
2. A reset is refused until the position is back below the limit. A muscle that has lost its load may have to be pulled back.
3. Look at the recording before the fault: a slope means that the muscle moved, a single point is a wrong reading of the sensor.
4. Reset, arm.

## Margin

In metres: the position, of `max_travel_m`. With 0.035 a reference of 20 mm gives used 0.57. Negative positions give a negative number.

## Not detected

- Travel in the other direction: a muscle that is pulled too long is not detected.
- Anything without a fresh position ([sensor_stale](sensor_stale.md)), or beyond the sensor's range.
- Force. A blocked muscle does not travel and may pull hard: no sensor measures that.
"""


class EnergyBudgetExceeded(FaultError):
    """The muscle got more energy, over about a minute, than it may take. This is a second check of the heat, which needs no thermal bounds."""

    number = 32
    name = "energy_budget_exceeded"
    meaning = """\
The muscle got more energy, over about a minute, than it may take. This is a second check of the heat, which needs no thermal bounds."""
    remedy = """\
1. Let the muscle rest. The account falls by 63 % in a minute; the reset is refused until the account is below the limit.
2. Is the reference's mean power (the row's applied_W) what you planned?
3. Raise the budget only if the muscle's temperature allows it."""
    page = """\
# 32 energy_budget_exceeded

The muscle got more energy, over about a minute, than it may take. This is a second check of the heat, which needs no thermal bounds.

**Detected** at once when the account passes `energy_J`: by default 1.1 `max_W` × `energy_window_s`, 297 J
for 4.5 W and 60 s. The account adds the largest power that may have been applied: the set power, the measured power if that is clearly more, or the
channel's maximum power if there is no current reading. It loses 1/60 of its content each second: a constant 4.95 W just fills it after a long time, 6.9 W
after 76 s, 14.4 W after 25 s.

**Reaction:** the channel goes cold.

**The default trips only when more power flows than was demanded.** Holding `max_W` indefinitely does not trip it; derating then protects, as far
as the thermal bounds are true, and later controller_invalid. For muscles that may take a burst of power, but not permanently, set `energy_J`
below `max_W` × the window: with 240 J, 4.5 W trips after 132 s.

## Likely causes

- a budget that is too small for the reference
- a command `power` for too long
- a switch that conducts by itself
- a stiffer load, or colder surroundings: the same motion takes more power

## Remedy

1. Let the muscle rest. The account falls by 63 % in a minute; the reset is refused until the account is below the limit.
2. Is the reference's mean power (the row's `applied_W`) what you planned?
3. Raise the budget only if the muscle's temperature allows it.

## Margin

In joules: the content of the account, of 297. At a mean of 2.5 W it settles at 150 J, used 0.51.

## Not detected

- Power that exceeds the set power by less than 10 mA × supply + 5 %: it is taken for the sense's error. While off: below 0.12 W.
- Anything before boot: the account starts empty.
"""


class ResistanceDrift(FaultError):
    """The heater's resistance is far from its calibration. Silver wears off a muscle with use, so the resistance rises; turns
that touch lower it."""

    number = 33
    name = "resistance_drift"
    meaning = """\
The heater's resistance is far from its calibration. Silver wears off a muscle with use, so the resistance rises; turns
that touch lower it."""
    remedy = """\
1. Look at the margin: how many ohms off?
2. Switch the supply off. Measure at the terminals, and at the muscle itself.
3. If the muscle is worn, replace it. 30 % more resistance is 30 % less silver on average; where the silver is thinnest, the thread gets hotter than
   the firmware can know.
4. If the new value is right, put it into the configuration (cold_resistance_Ohm), remove the values that were learned with the old one,
   and restart. calibrate cannot help: it needs an armed channel, and arming already ends in this fault."""
    page = """\
# 33 resistance_drift

The heater's resistance is far from its calibration. Silver wears off a muscle with use, so the resistance rises; turns
that touch lower it.

**Detected** when a probe ends: at each arming, in `calibrate`, and while active if the last resistance is older than 5 s, that is, at duties below the
probe's. The probe is a pulse of 2 % for 50 ms; its second half is measured. The result is compared with the calibrated cold resistance or, if the heater
has a coefficient, with that resistance at the temperature that fits best between the estimate's cold and hot end. More than 30 % either way trips (`resistance_ratio`). While
heating, the smoothed resistance is judged in the same way, and trips after 0.5 s: a sense that reads too little current would make the power
stage give more power. From four times the cold resistance on it is [heater_open](heater_open.md).

**Reaction:** the channel goes cold. Arming thus ends in `fault`, not in `armed`.

## Likely causes

- a worn muscle
- a muscle other than the configured one
- a contact with a resistance of some ohms
- few steps of PWM or a coarse converter: at 2 % a 10 Ω muscle draws only 24 mA at 12 V

## Remedy

1. Look at the margin: how many ohms off?
2. Switch the supply off. Measure at the terminals, and at the muscle itself.
3. If the muscle is worn, replace it. 30 % more resistance is 30 % less silver on average; where the silver is thinnest, the thread gets hotter than
   the firmware can know.
4. If the new value is right, put it into the configuration (`cold_resistance_Ohm`), remove the values that were learned with the old one,
   and restart. `calibrate` cannot help: it needs an armed channel, and arming already ends in this fault.

## Margin

In ohms: the resistance, and the limit on the same side of the calibrated value. 11.2 Ω for 10 Ω: 11.2 of 13, used 0.86; 8.8 Ω: limit 7,
used 0.8. An unchanged muscle uses 0.77. The margin keeps the value of the last measurement, so watch how it grows over weeks.

## Not detected

- A change between probes, at duties that are too small to measure the resistance.
- With a coefficient, any change that a temperature within the interval explains. The wider the interval, the larger the change.
- Slow wear of a muscle that is calibrated repeatedly: each calibration sets a new base.
"""


class MuscleLoose(FaultError):
    """A muscle of a joint gets its maximum allowed power, more is demanded, and the joint does not move: 'moved 0.05 of the 3.2 mm expected'.
The muscle is torn, or its cable is slack. Single muscles are judged by heater_not_responding only."""

    number = 34
    name = "muscle_loose"
    meaning = """\
A muscle of a joint gets its maximum allowed power, more is demanded, and the joint does not move: 'moved 0.05 of the 3.2 mm expected'.
The muscle is torn, or its cable is slack. Single muscles are judged by heater_not_responding only."""
    remedy = """\
1. Let both muscles cool. Turn the joint by hand, both ways: each muscle should become taut.
2. Is one muscle loose? Fasten it, tighten its cable, calibrate both muscles.
3. Did the joint move the wrong way? identify shows whether heat moves it the wrong way (moved_backwards). Then do one of these: swap both heaters
   with their current senses; change the sign of m_per_count, offset_m, min_m and max_m, and swap the last two; or swap agonist and
   antagonist in [joint], and move channel.position unchanged to the new agonist.
4. Are both muscles taut? Then find what held the joint. Set max_travel_m so that it lies within the end stops.
5. Reset, arm."""
    page = """\
# 34 muscle_loose

A muscle of a [joint](../joints.md) gets its maximum allowed power, more is demanded, and the joint does not move: "moved 0.05 of the 3.2 mm expected".
The muscle is torn, or its cable is slack. Single muscles are judged by [heater_not_responding](heater_not_responding.md) only.

**Detected** while a muscle is limited without a gap, by its maximum, its temperature or the supply. The expected motion is counted from zero when the limit
begins, and again each time the joint has moved by 0.9 mm. The fault trips when the muscle should have moved the joint by at least 3 mm (three times
`responding_min_m`) and the joint has moved by less than 0.3 of that (`responding_ratio`), for 0.5 s. The expected motion is the smallest of the models
of the muscle's heat, without the other muscle or with its heat times any factor up to ten, as in heater_not_responding. In simulation it trips 0.9 to
1.8 s after a muscle tore ([joints](../joints.md#safety)).

It also trips if the joint **moves the other way**: three times in a row every model expected another millimetre from a limited muscle, and the joint moved
by at least 0.3 of that in the other direction. So swapped heaters, or a sensor with the wrong sign, are found once the controller has driven a muscle to
its limit: in simulation 1 to 13 s after arming, if the limit moves the joint by 3 mm at all ([attacks](../attacks.md#joints)).

**Torn or slack is one fault**, because one position sensor cannot tell them apart: a torn muscle moves nothing, a slack one moves nothing until its slack is
taken up, and only more heat would show whether that happens.

**Which muscle** is loose can be read from the recording: both channels have this fault, and it concerns the one whose `applied_W` was at its maximum.
The position shows it too: a joint below its reference has lost its agonist, one above it its antagonist.

**Reaction:** both channels of the joint go cold. The expected motion is counted from zero; a reset is not refused because of this fault.

## Likely causes

- the muscle is torn, or came off its anchor or the lever
- its cable slipped off its pulley, or became longer than the muscle can take up
- the joint is held: by an end stop before its set point, or by something stronger than the muscle
- the sensor's magnet turns on its axle
- the joint moves away from its set point: both heaters are swapped, or the position has the wrong sign
- a load that grows, for seconds, while the muscle is at its limit

## Remedy

1. Let both muscles cool. Turn the joint by hand, both ways: each muscle should become taut.
2. Is one muscle loose? Fasten it, tighten its cable, `calibrate` both muscles.
3. Did the joint move the wrong way? `identify` shows whether heat moves it the wrong way (`moved_backwards`). Then do one of these: swap both heaters
   with their current senses; change the sign of `m_per_count`, `offset_m`, `min_m` and `max_m`, and swap the last two; or swap `agonist` and
   `antagonist` in `[[joint]]`, and move `[channel.position]` unchanged to the new agonist.
4. Are both muscles taut? Then find what held the joint. Set `max_travel_m` so that it lies within the end stops.
5. Reset, arm.

## Margin

In metres, a minimum: how far the joint moved since the counting began, and 0.3 of how far the muscle should have moved it. While less than 3 mm is
expected, or no muscle is limited, used is 0. If the joint moved the other way, a maximum: how far it moved during the last expected millimetre, and 0.3
of that expected motion.

## Not detected

- A loose muscle from which no more is demanded than its limit: the other muscle, a spring or a load does its work.
- A loose muscle that is already hot when it reaches its limit, because nothing pulls the joint away: then no motion is expected, and
  [controller_invalid](controller_invalid.md) follows after 120 s.
- A demand that falls below the limit again and again, for example because it is noisy: the expected motion is then counted from zero each time.
- Slack that the other muscle takes up at once, because both stay taut: the joint jumps by a part of the slack and continues to follow. Less pretension
  is left; `calibrate` again.
- A joint that moves the wrong way with muscles whose limit moves it by less than 3 mm. [over_travel](over_travel.md) ends the motion, and `identify` shows
  the cause.
- If the other muscle pulls the joint out of its travel: [over_travel](over_travel.md) trips first, within 0.1 s.
"""


class UnderVoltage(FaultError):
    """The supply is too low, or it cannot be measured. No duty can be computed from an unknown supply."""

    number = 40
    name = "under_voltage"
    meaning = """\
The supply is too low, or it cannot be measured. No duty can be computed from an unknown supply."""
    remedy = """\
1. Measure at the board's terminals, with all channels active.
2. If the voltage is right there, but the row's supply_V is wrong (0 means absent), check divider, converter and scaling.
3. If it is low only under load, check the supply and its wires.
4. Reset each channel. The first reset starts the self-test; when the test has passed, the heartbeat beats."""
    page = """\
# 40 under_voltage

The supply is too low, or it cannot be measured. No duty can be computed from an unknown supply.

**Detected** when the supply is below 10.8 V, or its reading is absent (older than 10 ms, or an error), for 20 ms
(`supply.min_V`, `supply.hold_ms`; the age is `max_age_ms` of the supply's input).

**Reaction:** every channel cold, heartbeat off. If the reading is absent, the duty is 0 already during those 20 ms.

## Likely causes

- the supply is off. A board that starts without supply has this fault 0.1 s after boot; the self-test waits
- the supply sags under load: it is too weak, its wires are long and thin, or its current is limited
- an empty battery
- a wrong divider or converter in the measurement

## Remedy

1. Measure at the board's terminals, with all channels active.
2. If the voltage is right there, but the row's `supply_V` is wrong (0 means absent), check divider, converter and scaling.
3. If it is low only under load, check the supply and its wires.
4. Reset each channel. The first reset starts the self-test; when the test has passed, the heartbeat beats.

## Margin

In volts, a minimum. 12.0 V over 10.8 V is used 0.90. The rows carry `supply_V` itself.

## Not detected

- Anything behind the supply switch, because the supply is measured before it. A blown fuse, or a pump that does not pump, shows as
  [heater_open](heater_open.md).
- Dips shorter than 20 ms.
- A supply reading that is wrong by a constant factor: the power is then wrong too. The temperature's hot end [counts that](../safety.md#power) as far as
  the configured range of the supply allows.
"""


class OverVoltage(FaultError):
    """The supply is above the voltage for which the board is made."""

    number = 41
    name = "over_voltage"
    meaning = """\
The supply is above the voltage for which the board is made."""
    remedy = """\
1. Measure at the terminals before anything is reset.
2. If it is too high, replace the supply. Raise the limit only if transistors, capacitors and pump are made for it.
3. If the voltage is right, the scaling is wrong. Then every power was wrong as well: too low if the supply reads too high. Correct the
   scaling.
4. Reset each channel."""
    page = """\
# 41 over_voltage

The supply is above the voltage for which the board is made.

**Detected** when the supply reads more than 13.2 V for 20 ms (`supply.max_V`, `supply.hold_ms`).

**Reaction:** every channel cold, heartbeat off: the supply switch opens and keeps the voltage from the power switches, but not from parts that are
wired before it.

Below the limit a muscle's power does not rise with the voltage, because the duty follows the measured supply.

## Likely causes

- a wrong or wrongly adjusted supply
- an unregulated supply without load
- something feeds back into the supply, such as a motor
- a wrong divider in the measurement

## Remedy

1. Measure at the terminals **before** anything is reset.
2. If it is too high, replace the supply. Raise the limit only if transistors, capacitors and pump are made for it.
3. If the voltage is right, the scaling is wrong. Then every power was wrong as well: too low if the supply reads too high. Correct the
   scaling.
4. Reset each channel.

## Margin

In volts. 12.0 of 13.2 V, used 0.91. The rows carry `supply_V` itself.

## Not detected

- Spikes shorter than 20 ms: use a suppressor on the board.
- A supply that cannot be measured: that is [under_voltage](under_voltage.md).
- A converter that clips below the limit. Its full scale must lie well above 13.2 V.
"""


class PowerLimitExceeded(FaultError):
    """The channel draws more power than can have been demanded."""

    number = 42
    name = "power_limit_exceeded"
    meaning = """\
The channel draws more power than can have been demanded."""
    remedy = """\
1. Compare applied_W with supply × current in the recording. If they agree until the end, the two limits are inconsistent.
2. If they differ by a constant factor, a scaling is wrong. Check the sense with a known resistor.
3. If they diverge suddenly, check the switch, with the supply off.
4. Reset, arm."""
    page = """\
# 42 power_limit_exceeded

The channel draws more power than can have been demanded.

**Detected** when supply × averaged current is above 1.25 `max_W` + 0.3 W (5.9 W for 4.5 W), or NaN, for 100 ms (`max_measured_W`, `over_power_ms`).
It is judged in every state, also while off.

**Reaction:** the channel goes cold. If the current continues, [heater_stuck_on](heater_stuck_on.md) follows 50 ms later and opens the
supply.

## Likely causes

- a switch that conducts by itself while the duty is high (at a low duty [heater_short](heater_short.md) is faster)
- the resistance from which the duty was computed is too high: the true one is lower, so more power flows
- `max_W` was raised, but `max_measured_W` was not: it must exceed max_W by the measurement error
- sense or supply is scaled wrongly

## Remedy

1. Compare `applied_W` with supply × current in the recording. If they agree until the end, the two limits are inconsistent.
2. If they differ by a constant factor, a scaling is wrong. Check the sense with a known resistor.
3. If they diverge suddenly, check the switch, with the supply off.
4. Reset, arm.

## Margin

In watts: measured power, of 5.9 W. 4.5 W is used 0.76.

## Not detected

- Excess power while the sense or the supply reads too low.
- Bursts of less than 100 ms. In 100 ms, 14.4 W (12 V on 10 Ω) warms the paper's muscle by some 9 K.
- Any power without a current reading.
"""


class Overrun(FaultError):
    """The firmware does not complete its ticks in time."""

    number = 50
    name = "overrun"
    meaning = """\
The firmware does not complete its ticks in time."""
    remedy = """\
1. supercoil doctor: each warning about kernel, priority, memory or clock comes with its remedy.
2. Stop supercoild and run supercoild --latency --config board.toml. It runs the same ticks without devices. If the ticks are
   long or late there too, the cause is priority, processor or memory (real time).
3. If they are short and punctual there, compare with execution_s of Timing on the running board,
   which the page shows. If that is much longer already while all channels are disarmed, a device is too slow to be
   direct.
4. If it becomes long only when channels are active, lower rate_Hz, or use fewer channels or simpler controllers.
5. Reset each channel; the self-test follows."""
    page = """\
# 50 overrun

The firmware does not complete its ticks in time.

**Detected** when 5 periods were left out without a punctual tick between them (`overruns_in_a_row`): in several
consecutive short overruns, or in one stall. After an overrun whole periods are left out; two ticks never run back to
back. One punctual tick resets the count to 0.

**Reaction:** every channel cold, heartbeat off.

During the stall the charge pump protects: if no edge arrives within its decay time, it opens the supply, whatever the
firmware does. The decay must exceed twice the tolerated overruns, or the configuration is refused: with 5 periods of 1 ms it
must be longer than 10 ms. So a stall that opens the supply is always a fault as well, and nothing heats again by itself.

Periods that were left out count for all hold times, for the expiry of commands and for the temperature estimate, up to
1000 of them.

## Likely causes

- another thread at a higher or equal priority, or interrupts on the same core
- page faults, a debugger, a suspended machine
- too many channels or too costly laws for the rate
- a direct device that takes longer than 20 µs

## Remedy

1. `supercoil doctor`: each warning about kernel, priority, memory or clock comes with its remedy.
2. Stop supercoild and run `supercoild --latency --config board.toml`. It runs the same ticks without devices. If the ticks are
   long or late there too, the cause is priority, processor or memory ([real time](../realtime.md)).
3. If they are short and punctual there, compare with `execution_s` of [Timing](../can-protocol.md#timing) on the running board,
   which the page shows. If that is much longer already while all channels are disarmed, a device is too slow to be
   [direct](../porting.md#direct-or-behind-a-bus).
4. If it becomes long only when channels are active, lower `rate_Hz`, or use fewer channels or simpler controllers.
5. Reset each channel; the self-test follows.

## Margin

A count of periods, of 5. `overruns` of [Timing](../can-protocol.md#timing) counts all periods that were left out since boot.

## Not detected

- Overruns of fewer than 5 consecutive periods. Tracking suffers, because controllers and filters assume regular steps; the
  protection takes the omitted time into account.
"""


class TickLate(FaultError):
    """The loop wakes later than requested. The ticks still end in time, but their timing is not that for which filters and controllers
were computed."""

    number = 51
    name = "tick_late"
    meaning = """\
The loop wakes later than requested. The ticks still end in time, but their timing is not that for which filters and controllers
were computed."""
    remedy = """\
1. supercoil doctor: each warning about kernel, priority, memory or clock comes with its remedy.
2. Stop supercoild and run supercoild --latency --config board.toml --plot latency.svg. If all ticks are late by the same amount,
   suspect a power-saving state; a few ticks that are very late point to another thread or to interrupts.
3. Give the loop its own core, a real-time priority, and locked memory (real time).
4. Raise late_ms only when you know the cause of the maximum.
5. Reset each channel."""
    page = """\
# 51 tick_late

The loop wakes later than requested. The ticks still end in time, but their timing is not that for which filters and controllers
were computed.

**Detected** when 5 consecutive ticks woke more than 0.5 ms after their time (`late_ms`, `late_in_a_row`).

**Reaction:** every channel cold, heartbeat off.

The default is half a period: 0.5 ms at 1 kHz.

## Likely causes

- the thread has no real-time priority, or the kernel is not a real-time kernel
- a power-saving state of the CPU from which it wakes slowly
- another thread on the same core
- interrupts of a network interface or a disk

## Remedy

1. `supercoil doctor`: each warning about kernel, priority, memory or clock comes with its remedy.
2. Stop supercoild and run `supercoild --latency --config board.toml --plot latency.svg`. If all ticks are late by the same amount,
   suspect a power-saving state; a few ticks that are very late point to another thread or to interrupts.
3. Give the loop its own core, a real-time priority, and locked memory ([real time](../realtime.md)).
4. Raise `late_ms` only when you know the cause of the maximum.
5. Reset each channel.

## Margin

A count of ticks, of 5. How late the ticks are is in `late_s` of [Timing](../can-protocol.md#timing): the maximum since the
previous frame.

## Not detected

- Single late ticks, however late, and any pattern with a punctual tick in between. Timing shows them.
- A clock that runs fast or slow.
"""


class TelemetryDead(FaultError):
    """The telemetry thread has stopped. The board can no longer be watched, and commands may not arrive, so nothing should be hot."""

    number = 52
    name = "telemetry_dead"
    meaning = """\
The telemetry thread has stopped. The board can no longer be watched, and commands may not arrive, so nothing should be hot."""
    remedy = """\
1. Is the process still running, with all its threads? For what does the thread wait?
2. If it is only late, find out what keeps the machine busy; the thread must not use a disk or a bus that blocks.
3. Restart the firmware: a reset does not restart a thread that has ended.
4. If the thread is alive again by itself, reset each channel."""
    page = """\
# 52 telemetry_dead

The telemetry thread has stopped. The board can no longer be watched, and commands may not arrive, so nothing should be hot.

**Detected** when the counter that the thread increments has not changed for 0.5 s (`telemetry_timeout_ms`). The counter must
run from boot on.

**Reaction:** every channel cold, heartbeat off.

## Likely causes

- the thread has ended, or hangs in a call that blocks
- the thread is starved: too low a priority on a busy machine
- a program of your own that runs the loop and does not increment `Health::telemetry_heartbeats`

## Remedy

1. Is the process still running, with all its threads? For what does the thread wait?
2. If it is only late, find out what keeps the machine busy; the thread must not use a disk or a bus that blocks.
3. Restart the firmware: a reset does not restart a thread that has ended.
4. If the thread is alive again by itself, reset each channel.

## Margin

In seconds: how long the counter has not changed, of 0.5 s.

## Not detected

- A thread that increments its counter and does nothing else.
- Lost telemetry. Rows that did not fit into the buffer are counted and reported in the log; that is not a fault.
- In the simulation there is no telemetry thread: its runner increments the counter at each tick.
"""


class CommandTimeout(FaultError):
    """The master has fallen silent: every command to heat expires unless it is renewed."""

    number = 60
    name = "command_timeout"
    meaning = """\
The master has fallen silent: every command to heat expires unless it is renewed."""
    remedy = """\
1. Find out what the sender was doing at the time of the fault.
2. Send commands every 50 to 80 ms, even if nothing changes.
3. Stop sending before you reset: commands to heat are now refused, and ten consecutive refused commands prevent the
   reset (command_not_allowed).
4. Reset, arm, command."""
    page = """\
# 60 command_timeout

The master has fallen silent: every command to heat expires unless it is renewed.

**Detected** when a channel has been active for more than 0.25 s without a renewal (`command.timeout_ms`). `position`,
`power` and `renew` renew; `identify` and `calibrate` renew only when they start, so they need `renew` while they run.
Periods that were left out after an [overrun](overrun.md) count as time without a renewal.

**Reaction:** the channel goes cold. At full power (4.5 W) the paper's muscle warms by some 7 K in that time.

## Likely causes

- the commanding program ended, hangs, or lost its connection
- the program stopped with its last command still in force: end with `rest` or `disarm`
- the program renews too rarely: leave room for three renewals within 0.25 s
- it renews another channel

## Remedy

1. Find out what the sender was doing at the time of the fault.
2. Send commands every 50 to 80 ms, even if nothing changes.
3. Stop sending before you reset: commands to heat are now refused, and ten consecutive refused commands prevent the
   reset ([command_not_allowed](command_not_allowed.md)).
4. Reset, arm, command.

## Margin

In seconds: the age of the last renewal, of 0.25 s. 0.06 of 0.25 is used 0.24. The maximum over a day shows how close
the connection is to failing. While the channel is not active it is 0.

## Not detected

- A program whose control part hangs while another part still renews.
- A wrong command that is renewed.
"""


class CommandDamaged(FaultError):
    """Commands arrive with a wrong checksum or a counter that does not follow."""

    number = 61
    name = "command_damaged"
    meaning = """\
Commands arrive with a wrong checksum or a counter that does not follow."""
    remedy = """\
1. If all channels on the bus have this fault, the cause is the bus; if only one channel has it, the cause is that channel's sender.
2. Stop all senders but one.
3. Check termination and wiring of the bus.
4. Reset, arm. If damaged commands still arrive, the fault returns within ten of them."""
    page = """\
# 61 command_damaged

Commands arrive with a wrong checksum or a counter that does not follow.

**Detected** at the tenth consecutive tick with a damaged command (`damaged_in_a_row`). Ticks without any command do not count; a tick with only
intact commands resets the count. Damaged commands are never obeyed.

**Reaction:** the channel goes cold.

Only commands over CAN are checked ([can.md](../can.md#commanding)). A tick with both an intact and a damaged command counts as damaged.

## Likely causes

- a bus with wrong termination, or too long
- two senders on one channel, whose counters do not agree
- a sender of another version of the protocol

## Remedy

1. If all channels on the bus have this fault, the cause is the bus; if only one channel has it, the cause is that channel's sender.
2. Stop all senders but one.
3. Check termination and wiring of the bus.
4. Reset, arm. If damaged commands still arrive, the fault returns within ten of them.

## Margin

A count, of 10. Used 0.3 means three consecutive damaged commands. The count does not change while no command arrives.

## Not detected

- Damage after which the checksum is still right: 1 in 256 of the errors of 4 bits or more.
- Damage to every second command: the count never reaches 10. The intact commands are then still obeyed.
- A sender from which nothing arrives at all: [command_timeout](command_timeout.md).
"""


class CommandNotAllowed(FaultError):
    """A program keeps sending commands that the channel's state does not allow. Sender and board disagree about what the channel is
doing."""

    number = 62
    name = "command_not_allowed"
    meaning = """\
A program keeps sending commands that the channel's state does not allow. Sender and board disagree about what the channel is
doing."""
    remedy = """\
1. Stop the stream first. The count stays at its limit while refused commands arrive: a reset among them is not obeyed, and is
   answered with 'cause persists'.
2. Send reset, alone in its tick and not in the tick after another one.
3. Let the sender read the channel's state: send commands to heat only when it is armed or active.
4. Find the other sender, if there is one."""
    page = """\
# 62 command_not_allowed

A program keeps sending commands that the channel's state does not allow. Sender and board disagree about what the channel is
doing.

**Detected** at the tenth consecutive tick with a command that was refused as "wrong state" (`refused_in_a_row`). Ticks
without a command do not count; a tick with only other answers resets the count. Refusals for other reasons (out of range,
busy, not ready) do not count either.

**Reaction:** the channel goes cold. Usually it is already cold; then it only changes from `disarmed` to `fault`.

## Likely causes

- a stream of `position` or `power` that starts before the channel is armed
- a stream, or `renew`, that continues after `rest`, `disarm`, or another fault
- two programs that command the same channel

## Remedy

1. **Stop the stream first.** The count stays at its limit while refused commands arrive: a reset among them is not obeyed, and is
   answered with "cause persists".
2. Send `reset`, alone in its tick and not in the tick after another one.
3. Let the sender read the channel's state: send commands to heat only when it is `armed` or `active`.
4. Find the other sender, if there is one.

## Margin

A count, of 10. It does not change while no command arrives. An occasional 0.1 to 0.3 means that the sender lags a little behind the
state.

## Not detected

- Refused and obeyed commands that alternate, each in its own tick.
- Commands that are allowed but wrong.
"""


class EmergencyStop(FaultError):
    """The emergency stop is pressed, its circuit is broken, or its input cannot be read. The firmware treats all three alike."""

    number = 63
    name = "emergency_stop"
    meaning = """\
The emergency stop is pressed, its circuit is broken, or its input cannot be read. The firmware treats all three alike."""
    remedy = """\
1. Make sure that the reason for pressing it is gone.
2. Release the button; the input must read high.
3. Reset each channel. The first reset starts the self-test, 0.23 s; then arm.
4. If the button is not pressed, measure the loop: the input is high when the loop is closed."""
    page = """\
# 63 emergency_stop

The emergency stop is pressed, its circuit is broken, or its input cannot be read. The firmware treats all three alike.

**Detected** at once: the input is read at each tick, and everything except "high, read without an error" trips.

**Reaction:** every channel cold and the heartbeat off in the same tick; the supply opens after the pump's decay, 20 ms.
The fault remains when the stop is released. While the stop is pressed, the self-test does not run; if it is pressed during the self-test, the
test ends in the same tick. In the first 0.1 s after boot no fault is latched, but everything is off.

## Likely causes

- the button was pressed. Find out why before you release it
- a wire of the loop is broken, a plug is open
- the firmware does not hold the input's line

## Remedy

1. Make sure that the reason for pressing it is gone.
2. Release the button; the input must read high.
3. Reset each channel. The first reset starts the self-test, 0.23 s; then arm.
4. If the button is not pressed, measure the loop: the input is high when the loop is closed.

## Margin

A flag: 0 is closed, 1 is open, the limit is 0.

## Not detected

- A wire shorted to the level "high".
- **A stop that only the firmware reads is not a stop.** Its contacts must also break the supply or the pump's input by
  themselves: [wiring](../wiring.md).
"""


class BusOff(FaultError):
    """The CAN controller has left the bus: so many of its own frames failed that it went silent, as the standard demands. Or its interface is down,
which is equivalent for the board."""

    number = 70
    name = "bus_off"
    meaning = """\
The CAN controller has left the bus: so many of its own frames failed that it went silent, as the standard demands. Or its interface is down,
which is equivalent for the board."""
    remedy = """\
1. With the bus unpowered, measure between CAN-H and CAN-L: 60 Ω.
2. Compare the bit rates of all nodes.
3. Unplug nodes one by one.
4. When the controller is back on the bus, reset each channel."""
    page = """\
# 70 bus_off

The CAN controller has left the bus: so many of its own frames failed that it went silent, as the standard demands. Or its interface is down,
which is equivalent for the board.

**Detected** in the tick in which the telemetry thread reports it (`can_bus_off_ms` is 0: at once).

**Reaction:** every channel goes cold. The heartbeat continues, because a bus fault is no reason to doubt the switches. So the fault's scope in
the table is `channel`, although it affects all channels. Any fault of the board, such as the emergency stop or a stuck switch, still stops the
heartbeat. While the fault lasts, no self-test begins and no fault of the board can be reset.

`supercoild` reports the state of the interface in `[can]`; without `[can]`, and in the simulation, the state stays "active".

## Likely causes

- CAN-H and CAN-L swapped or shorted
- a wrong bit rate
- no termination, or only one terminator of two
- the interface was never brought up, or was taken down
- no other node: no acknowledge (that leads to [bus_error_passive](bus_error_passive.md) first)

## Remedy

1. With the bus unpowered, measure between CAN-H and CAN-L: 60 Ω.
2. Compare the bit rates of all nodes.
3. Unplug nodes one by one.
4. When the controller is back on the bus, reset each channel.

## Margin

In seconds: for how long the controller has been off, of 0. Used is 0 while the bus works, and infinite when it is off.

## Not detected

- A bus that works and carries no frames: [command_timeout](command_timeout.md), while something is hot.
"""


class BusErrorPassive(FaultError):
    """The CAN controller sees so many errors that it no longer marks them on the bus ('error passive'). It still works; the
next step is bus_off."""

    number = 71
    name = "bus_error_passive"
    meaning = """\
The CAN controller sees so many errors that it no longer marks them on the bus ('error passive'). It still works; the
next step is bus_off."""
    remedy = """\
1. Is the board alone on the bus? Connect a second node, or do not use the bus.
2. Check the termination: 60 Ω between CAN-H and CAN-L, with terminators at the ends and nowhere else.
3. Look at the controller's error counters: transmit errors without receive errors mean that no node receives.
4. Reset each channel once the counters fall."""
    page = """\
# 71 bus_error_passive

The CAN controller sees so many errors that it no longer marks them on the bus ("error passive"). It still works; the
next step is [bus_off](bus_off.md).

**Detected** when the state is error-passive, bus-off or down for 1 s without interruption (`can_error_passive_ms`). Bus-off is detected
earlier, as a separate fault.

**Reaction:** as for bus_off: every channel goes cold, and the heartbeat continues. While the fault lasts, no self-test begins and no fault of the board can
be reset.

Without `[can]` in the configuration, and in the simulation, this fault cannot occur.

## Likely causes

- the board is alone on its bus: no node acknowledges. Typical on a bench
- termination or wiring that is not quite right
- interference: a motor's cable beside the bus
- a bit rate that is slightly off

## Remedy

1. Is the board alone on the bus? Connect a second node, or do not use the bus.
2. Check the termination: 60 Ω between CAN-H and CAN-L, with terminators at the ends and nowhere else.
3. Look at the controller's error counters: transmit errors without receive errors mean that no node receives.
4. Reset each channel once the counters fall.

## Margin

In seconds: how long the controller has been error-passive, of 1 s. Short periods that never reach 1 s show a bus that is close to failing.

## Not detected

- Errors below the controller's own limit of 128.
"""


class NodeConflict(FaultError):
    """Another board on the CAN bus uses a node of this board. Both would obey each other's masters, and their telemetry would
be mixed. Neither can know to which board the node belongs, so both boards go cold."""

    number = 72
    name = "node_conflict"
    meaning = """\
Another board on the CAN bus uses a node of this board. Both would obey each other's masters, and their telemetry would
be mixed. Neither can know to which board the node belongs, so both boards go cold."""
    remedy = """\
1. supercoil monitor with one of the boards unplugged shows which nodes are taken.
2. Give each board its own first_node in [can](../configuration.md#can), and restart it.
3. Reset each channel of the board that kept its nodes."""
    page = """\
# 72 node_conflict

Another board on the CAN bus uses a node of this board. Both would obey each other's masters, and their telemetry would
be mixed. Neither can know to which board the node belongs, so both boards go cold.

**Detected** when the heartbeat (Status) of one of this board's own nodes is heard from another sender: at the tick after
the telemetry thread reads it. A board sends its heartbeat 10 times a second (at least once), so two boards detect each
other within 0.1 s (1 s). The fault's cause persists for 2.5 s after the last such frame. The board's own frames are
never among them, because the kernel does not return them to the socket that sent them.

**Reaction:** every channel cold, as for [bus_off](bus_off.md), and the heartbeat of the charge pump continues: a
wrong address is no reason to doubt the switches. While the conflict lasts, no self-test begins and nothing can be
reset or armed: a board does not become ready if its nodes are taken.

## Likely causes

- two boards with the same `first_node`, or with ranges of nodes that overlap
- a copied SD card
- a log that is replayed on the bus of the board that it was recorded from (`canplayer`)

## Remedy

1. `supercoil monitor` with one of the boards unplugged shows which nodes are taken.
2. Give each board its own `first_node` in [`[can]`](../configuration.md#can), and restart it.
3. Reset each channel of the board that kept its nodes.

## Margin

0, and 1 while another board is heard.

## Not detected

- A board whose control loop has stopped: it sends no heartbeat.
- Two boards with the same node on two buses that are not connected.
- A sender that forges this node's heartbeat makes it cold, as a `disarm` would.
"""


class ConfigurationInvalid(FaultError):
    """The configuration is no longer the one with which the firmware was started."""

    number = 80
    name = "configuration_invalid"
    meaning = """\
The configuration is no longer the one with which the firmware was started."""
    remedy = """\
1. Compare the file with the version that you trust.
2. If the change is intended: check it, and restart the firmware. A running firmware does not load a new configuration.
3. If the file was not edited: check the disk before you trust the board again.

A reset works only after the program has reported that the file is as before."""
    page = """\
# 80 configuration_invalid

The configuration is no longer the one with which the firmware was started.

**Detected** at the tick after another thread of the program reports it. `supercoild` does not watch its file, so this fault
cannot occur there: it is for programs of your own that run the loop (`Health::configuration_changed`).

**Reaction:** every channel cold, heartbeat off.

Settings that are wrong from the beginning do not cause this fault: supercoild names each mistake and does not start.

## Likely causes

In your own program:

- the file was edited while the board ran
- a package was updated under the running firmware
- a failing disk: the file was read differently

## Remedy

1. Compare the file with the version that you trust.
2. If the change is intended: check it, and restart the firmware. A running firmware does not load a new configuration.
3. If the file was not edited: check the disk before you trust the board again.

A reset works only after the program has reported that the file is as before.

## Margin

A flag: 0 is unchanged, 1 changed, the limit is 0.

## Not detected

- Values that are valid but wrong: thermal bounds of another muscle, another resistance. **No detector finds these.**
"""


class ControllerInvalid(FaultError):
    """The controller has failed: its demand is NaN, or it has demanded more than it can get for two minutes."""

    number = 81
    name = "controller_invalid"
    meaning = """\
The controller has failed: its demand is NaN, or it has demanded more than it can get for two minutes."""
    remedy = """\
1. If the margin is in seconds (120 of 120), the demand was limited. Look at limited_by in the recording: which limit, and for how long?
2. If it was the maximum, demand less, or allow more power if the muscle withstands it. If it was temperature or unproven, demand no more than can
   be held permanently (supercoild --check), or set shape_reference.
3. If it was NaN, look at the estimates before the fault, go back to a simpler controller, and identify again.
4. Reset, arm. A controller starts from scratch when it is activated."""
    page = """\
# 81 controller_invalid

The controller has failed: its demand is NaN, or it has demanded more than it can get for two minutes.

**Detected** in two ways:
- The demanded power is NaN or infinite: detected at the next tick. In the tick itself the limiter already gives 0 W (limited by: invalid).
- More was demanded than was given for 120 s without interruption while active (`saturated_s`), whichever limit reduced it: maximum,
  temperature, slew, supply. A demand below 0 W does not count, because it is normal while a muscle cools.

**Reaction:** the channel goes cold.

## Likely causes

- NaN: gains that diverge, a learned parameter with an absurd value
- a position that 4.5 W cannot reach: too much load, a softer muscle
- a set point that stays above the travel that can be held permanently, without `shape_reference`
- a command `power` above `max_W`
- a supply that is too weak for the demanded power

## Remedy

1. If the margin is in seconds (120 of 120), the demand was limited. Look at `limited_by` in the recording: which limit, and for how long?
2. If it was the maximum, demand less, or allow more power if the muscle withstands it. If it was temperature or unproven, demand no more than can
   be held permanently (`supercoild --check`), or set [`shape_reference`](../control.md#references-that-a-muscle-can-follow).
3. If it was NaN, look at the estimates before the fault, go back to a simpler controller, and `identify` again.
4. Reset, arm. A controller starts from scratch when it is activated.

## Margin

In seconds: how long the controller has demanded more than it got, of 120 s. After NaN, measured is NaN and used is infinite.

## Not detected

- A controller that oscillates or tracks badly within its limits.
- A demand that is limited except for a single tick in every two minutes.
- A controller that demands less than 0 W permanently.
"""


class SelfTestFailed(FaultError):
    """The board could not prove that it can cut the heat. It cannot be armed."""

    number = 82
    name = "self_test_failed"
    meaning = """\
The board could not prove that it can cut the heat. It cannot be armed."""
    remedy = """\
1. Find out which cut failed: the fault's measured is 1 for the supply switch with its pump, and 2 for an enable line or a
   power switch. The page and supercoil log --summary show it; on the bus it is in
   FirstCause.
2. Unplug the muscles. A sense that does not read 0 has an offset.
3. If it is 1, stop the firmware and measure behind the supply switch: there must be no voltage.
4. If it is 2, set a duty with the enable line low: it must not reach the gate.
5. Restart. A reset does not help: a test that has failed stays failed."""
    page = """\
# 82 self_test_failed

The board could not prove that it can cut the heat. It cannot be armed.

**Detected** in the self-test: at every boot, and again after every reset of a board's fault. It takes 0.23 s. The test sets a
pulse of the probe's duty (2 %, 30 ms) twice, each time while one of the two switches may conduct and the other is off:

| from | heartbeat | enable | duty | a current means |
|---|---|---|---|---|
| 0 | stopped | low | 0 | nothing yet: before a restart the firmware may have pumped until just now |
| 0.07 s | stopped | high | 2 % | the pump, or the supply switch, does not open |
| 0.10 s | beats | low | 0 | the power switch, or its gate, conducts by itself |
| 0.15 s | beats | low | 2 % | the enable line does not cut |
| 0.18 to 0.23 s | beats | low | 0 | as at 0.10 s |

The limit is the smaller of `current.off_A` (50 mA) and half of the current that the probe should draw at the lowest
supply (10.8 mA for 10 Ω and 10.8 V). From 0.07 s on, the test fails if the current of any channel is above the limit
on average over a pulse's second half, or above four times the limit for more than 9 ms at any time, with or without
a pulse.

**It waits,** with every line low, until the supply is within its limits, the stop circuit is closed, every channel has
a current reading and the board has no fault (a bus fault counts as well). If one of these conditions is lost, the test
stops in that tick, and starts again later. A missing condition becomes its own fault 0.1 s after boot, for example
[under_voltage](under_voltage.md); when the condition is met again, a reset starts the test.

**Reaction:** every channel goes to `fault`, the heartbeat stays off.

## Likely causes

- the supply switch is stuck closed, or the pump is bridged
- the pump decays more slowly than `charge_pump_decay_ms`, or another program drives the heartbeat
- an enable gate that has no effect; a power switch that conducts by itself
- the sense has an offset of more than 10.8 mA

## Remedy

1. Find out which cut failed: the fault's `measured` is 1 for the supply switch with its pump, and 2 for an enable line or a
   power switch. The page and `supercoil log --summary` show it; on the bus it is in
   [FirstCause](../can-protocol.md#firstcause).
2. Unplug the muscles. A sense that does not read 0 has an offset.
3. If it is 1, stop the firmware and measure behind the supply switch: there must be no voltage.
4. If it is 2, set a duty with the enable line low: it must not reach the gate.
5. Restart. A reset does not help: a test that has failed stays failed.

## Margin

0: passed. 1: failed, because the supply switch does not open when the heartbeat stops. 2: failed, because an enable line does not
cut, or a power switch conducts by itself. The limit is 0.

## Not detected

- Cases in which no current can flow or be measured anyway: no muscle, a sense that reads 0, a blown fuse behind the supply
  measurement. The test then passes without having proved anything; arming fails as [heater_open](heater_open.md).
- A cut that fails later, until the next test.
"""


BY_NUMBER: dict[int, type[FaultError]] = {
    10: SensorOutOfRange,
    11: SensorStale,
    12: SensorFrozen,
    13: SensorJump,
    14: SensorsDisagree,
    20: HeaterOpen,
    21: HeaterShort,
    22: HeaterStuckOn,
    23: HeaterNotResponding,
    24: DutyWrong,
    25: LineFailed,
    30: OverTemperature,
    31: OverTravel,
    32: EnergyBudgetExceeded,
    33: ResistanceDrift,
    34: MuscleLoose,
    40: UnderVoltage,
    41: OverVoltage,
    42: PowerLimitExceeded,
    50: Overrun,
    51: TickLate,
    52: TelemetryDead,
    60: CommandTimeout,
    61: CommandDamaged,
    62: CommandNotAllowed,
    63: EmergencyStop,
    70: BusOff,
    71: BusErrorPassive,
    72: NodeConflict,
    80: ConfigurationInvalid,
    81: ControllerInvalid,
    82: SelfTestFailed,
}
