# Generated from docs/faults by toolchain/generate-can. Do not edit.

"""An exception for each fault, with the text of its page."""

from supercoil.errors import FaultError


class SensorOutOfRange(FaultError):
    """The position reads a value that this sensor cannot give. Its wire is off, or shorted to a rail."""

    number = 10
    name = "sensor_out_of_range"
    meaning = """\
The position reads a value that this sensor cannot give. Its wire is off, or shorted to a rail."""
    remedy = """\
1. Read the position while the muscle is cold. A value far beyond either end is a rail: check the cable.
2. Move the free end by hand. If the value follows, but is off, check scaling and mounting.
3. Reset, arm."""
    page = """\
# 10 sensor_out_of_range

The position reads a value that this sensor cannot give. Its wire is off, or shorted to a rail.

**Detected** when the reading, scaled to metres but before the calibration of zero and scale, is below −2 mm or above
42 mm, or is NaN, for 5 ms without a gap (`position.min_m`, `position.max_m`, `out_of_range_ms`). One wild
conversion is forgiven.

**Reaction:** the channel goes cold.

During these 5 ms such a reading already counts as absent: nothing is computed from it, and the channel cannot be armed. It counts neither as travel nor
as a jump. Pull the input to a rail that lies outside the range.

## Likely causes

- the sensor's cable or plug
- the sensor has lost its supply
- a scaling (`m_per_count`, `offset_m`) that belongs to another sensor
- the sensor sits so that the muscle leaves its range

## Remedy

1. Read the position while the muscle is cold. A value far beyond either end is a rail: check the cable.
2. Move the free end by hand. If the value follows, but is off, check scaling and mounting.
3. Reset, arm.

## Margin

In metres: measured is the distance from the middle of the range (20 mm), the limit is half the range (22 mm).
A reading of 31 mm is 0.011 of 0.022, used 0.5. Used grows towards both ends. In normal work it stays below 0.91 over
0 to 40 mm; if it idles near 1, the sensor sits at its end.

## Not detected

- A broken wire on a board whose input has no pull: it floats, and may float inside the range
  ([wiring](../wiring.md)).
- A wrong value within the range. See [sensor_frozen](sensor_frozen.md) and
  [heater_not_responding](heater_not_responding.md).
- Anything while there is no fresh reading: then [sensor_stale](sensor_stale.md) speaks first.
"""


class SensorStale(FaultError):
    """There is no fresh position, or no fresh current. An old value is never used in its place."""

    number = 11
    name = "sensor_stale"
    meaning = """\
There is no fresh position, or no fresh current. An old value is never used in its place."""
    remedy = """\
1. See which one it is: position_m or current_A of the row is empty.
2. Compare the converter's period with max_age_ms, which needs room for two periods and the time on the bus.
3. If both inputs of several channels fail at once, it is the bus.
4. Reset, arm."""
    page = """\
# 11 sensor_stale

There is no fresh position, or no fresh current. An old value is never used in its place.

**Detected** at the first tick at which either is absent: the converter answers with an error, its newest conversion is
older than 10 ms (`max_age_ms` of the input; the settings of each input), or it comes from the future. So a converter
that falls silent is found after 10 ms and a tick, and one that reports an error at once.

**Reaction:** the channel goes cold. In that tick no power is computed from the old position. If the current is missing, nothing proves that the
heat is off: 50 ms later [heater_stuck_on](heater_stuck_on.md) opens the supply of the board.

While the current is absent the temperature estimate assumes anything between the power that was set and the channel's
greatest power.

## Likely causes

- the bus thread of a buffered converter stalls, or its bus hangs
- a converter slower than `max_age_ms`
- from the start: a capture's trigger that does not run, or that has too many devices
  ([porting.md](../porting.md#a-trigger-for-iioscan))
- the driver was unbound, or the device unplugged: when it is back, it must be opened again, so restart supercoild
- conversions stamped by another clock than the board's, which then lie in the future

## Remedy

1. See which one it is: `position_m` or `current_A` of the row is empty.
2. Compare the converter's period with `max_age_ms`, which needs room for two periods and the time on the bus.
3. If both inputs of several channels fail at once, it is the bus.
4. Reset, arm.

## Margin

A flag: measured 0 is fresh, 1 is absent, the limit is 0. Used is 0 or infinite: there is no early sign. The age itself is
not published.

## Not detected

- A driver that gives old values new times: [sensor_frozen](sensor_frozen.md), while hot.
- The name of another channel fault in the same tick. A fault of the whole board is not hidden.
"""


class SensorFrozen(FaultError):
    """The position stands still as no working sensor does: not even its noise is visible. The readings are new, so they are not stale, but they repeat."""

    number = 12
    name = "sensor_frozen"
    meaning = """\
The position stands still as no working sensor does: not even its noise is visible. The readings are new, so they are not stale, but they repeat."""
    remedy = """\
1. Look at the value: a reading that is position.min_m or max_m to the last digit is an end of the range. Move the sensor, or reduce the load.
2. Record one second of a working sensor at rest and compute its standard deviation. Put that, but at least a third of a converter step, into
   position.noise_rms_m.
3. If the sensor really shows no noise, set it to 0. The detector is then off, and you rely on heater_not_responding, which
   needs 20 s and more.
4. Otherwise restart the converter's driver. Reset, arm."""
    page = """\
# 12 sensor_frozen

The position stands still as no working sensor does: not even its noise is visible. The readings are new, so they are not stale, but they repeat.

**Detected** when, while the muscle is hot, all readings stay within ±5 µm of one of them for 1 s
(half of `position.noise_rms_m` = 10 µm; `frozen_s`). "Hot" means that the upper bound of the temperature estimate is
more than 5 K above the air, so for 15 s after boot as well, in every state.

**Reaction:** the channel goes cold.

## Likely causes

- a driver or bus thread that repeats its last value
- a converter that hangs
- the position is at an end of the sensor's range: for example a load pulls the muscle longer than the sensor can read, so that every reading is that end
- a sensor that is quieter than `position.noise_rms_m`: a filter was added, or the noise was guessed

## Remedy

1. Look at the value: a reading that is `position.min_m` or `max_m` to the last digit is an end of the range. Move the sensor, or reduce the load.
2. Record one second of a working sensor at rest and compute its standard deviation. Put that, but at least a third of a converter step, into
   `position.noise_rms_m`.
3. If the sensor really shows no noise, set it to 0. The detector is then off, and you rely on [heater_not_responding](heater_not_responding.md), which
   needs 20 s and more.
4. Otherwise restart the converter's driver. Reset, arm.

## Margin

In seconds: for how long the readings stood still while hot, of 1 s. A working sensor with the right noise stays below 0.02 s; used 0.3 means that it is
much quieter than configured.

## Not detected

- A frozen sensor of a cold muscle, or below a steady power of about 0.21 W with the default bounds: there the upper bound stays below 5 K.
- When `position.noise_rms_m` is 0.
- A frozen value that is replaced by a plausible, changing one.
"""


class SensorJump(FaultError):
    """The position moved further between two readings than any muscle can."""

    number = 13
    name = "sensor_jump"
    meaning = """\
The position moved further between two readings than any muscle can."""
    remedy = """\
1. Compare the position with what you see. If it is off by a constant, the sensor slipped: fix it, calibrate.
2. If the load is meant to move that fast, raise max_speed_m_per_s.
3. Only then reset. The detector will not keep you from resetting too early."""
    page = """\
# 13 sensor_jump

The position moved further between two readings than any muscle can.

**Detected** when two fresh readings in a row lie further from the last good one than 0.5 m/s times the time since the
previous reading, plus 0.17 mm (50 µm and 12 times the noise of 10 µm). At 1 kHz that is 0.67 mm. The first such reading
is taken for a glitch, the second one trips (`max_speed_m_per_s`, `position.noise_rms_m`). Readings outside the sensor's range do
not count: they are [sensor_out_of_range](sensor_out_of_range.md). The position is judged before zero and scale are applied, so a calibration is no jump.

**Reaction:** the channel goes cold. Then the detector accepts the new position: it no longer trips at the next reading, and a reset is not refused because
of it.

## Likely causes

- a loose plug, or a broken wire whose input floats inside the range
- the sensor slipped in its mounting, or was hit
- the load dropped: a real motion, faster than 0.5 m/s

## Remedy

1. Compare the position with what you see. If it is off by a constant, the sensor slipped: fix it, calibrate.
2. If the load is meant to move that fast, raise `max_speed_m_per_s`.
3. Only then reset. The detector will not keep you from resetting too early.

## Margin

In metres: the change, and what was allowed for the time between. At rest some 30 µm of 670 µm, used 0.04. Values near
1 in fast motion mean that `max_speed_m_per_s` is tight.

## Not detected

- Drift, and jumps of less than 0.67 mm.
- Jumps that come back before the next reading.
- With a slow converter more is allowed: 5.2 mm at 100 Hz.
"""


class SensorsDisagree(FaultError):
    """The heater's resistance indicates one temperature and the position another."""

    number = 14
    name = "sensors_disagree"
    meaning = """\
The heater's resistance indicates one temperature and the position another."""
    remedy = """\
1. Let it cool. When it is cold, both must read about 0 K; the one that does not is wrong.
2. If the position is wrong, find what holds the muscle, then calibrate. If the resistance is wrong, check crimps and plugs, then calibrate.
3. Reset, arm."""
    page = """\
# 14 sensors_disagree

The heater's resistance indicates one temperature and the position another.

**Off by default.** It is judged only if the resistance depends on temperature (`temperature_coefficient_per_K` above
0) and was measured within the last second. Silver-plated nylon may have no usable coefficient: measure it before you
switch this on.

**Detected** when both differ by more than 30 K for 2 s (`disagree_K`, `disagree_s`):
- from resistance: (R / cold R − 1) / coefficient
- from position: position × stiffness / force per kelvin, that is, as if the muscle were at rest under its usual load

**Reaction:** the channel goes cold.

## Likely causes

- the load changed, the muscle caught on something, or its end slipped: the position is misleading
- a contact warms up or wears: the resistance is misleading
- a coefficient or a cold resistance that belongs to another muscle

## Remedy

1. Let it cool. When it is cold, both must read about 0 K; the one that does not is wrong.
2. If the position is wrong, find what holds the muscle, then `calibrate`. If the resistance is wrong, check crimps and plugs, then `calibrate`.
3. Reset, arm.

## Margin

In kelvin: the difference, of 30 K. Example: resistance gives 42 K, position 30 K: 12 of 30, used 0.4.
While it is not judged, measured reads 0.

## Not detected

- Without a coefficient, and while duty is too small for a resistance.
- Small errors: with the paper's muscle 30 K is 16 mm of position, so only gross errors are found.
- Both wrong in the same direction.
"""


class HeaterOpen(FaultError):
    """Duty is applied, but hardly any current flows."""

    number = 20
    name = "heater_open"
    meaning = """\
Duty is applied, but hardly any current flows."""
    remedy = """\
1. Switch the supply off. Measure the muscle's resistance at the board's terminals.
2. If it is right: is there voltage behind the supply switch while the heartbeat beats? If not: fuse, pump, switch.
3. If there is: sense and power switch.
4. If all channels have this fault at once, it is the supply switch.
5. Reset, arm. The probe at arming tests it again."""
    page = """\
# 20 heater_open

Duty is applied, but hardly any current flows.

**Detected** in one of two ways:
- The duty, averaged like the current sense, is at least 2 % and the current stays below a quarter of what a cold muscle
  would draw at the lowest supply, for 20 ms: 0.27 A times the duty for 10 Ω and 10.8 V (`open_min_duty`, `open_ms`).
- A probe, at arming or later, found no current, or four times the cold resistance or more. That is known when the
  probe's 50 ms are over.

**Reaction:** the channel goes cold.

## Likely causes

- a wire, crimp or plug of the muscle; the muscle itself burned through
- no supply behind the switch: the charge pump does not pump, or a fuse has blown. The supply is measured before the
  switch and still looks good
- the power switch or its gate
- the current sense reads 0

## Remedy

1. Switch the supply off. Measure the muscle's resistance at the board's terminals.
2. If it is right: is there voltage behind the supply switch while the heartbeat beats? If not: fuse, pump, switch.
3. If there is: sense and power switch.
4. If all channels have this fault at once, it is the supply switch.
5. Reset, arm. The probe at arming tests it again.

## Margin

In amperes, a minimum: the current, and what it must be at this duty. At a duty of 0.3, 0.36 A flow where 0.081 A are needed:
used 0.22. A value closer to 1 means that the resistance has risen. Below a duty of 2 % the fault is not judged and used is 0, even
if the numbers look alarming.

## Not detected

- While the channel is off or its duty is below 2 %, except during probes.
- A resistance up to four times too high: that is [resistance_drift](resistance_drift.md), at the next probe.
"""


class HeaterShort(FaultError):
    """More current flows than the lowest resistance of a muscle explains."""

    number = 21
    name = "heater_short"
    meaning = """\
More current flows than the lowest resistance of a muscle explains."""
    remedy = """\
1. If the board's fault is heater_stuck_on, continue on its page.
2. Supply off. Measure the muscle's resistance; below 5 Ω it is shorted. Move it while measuring.
3. If the resistance is right, compare sense_filter_ms with the board's filter.
4. Reset, arm."""
    page = """\
# 21 heater_short

More current flows than the lowest resistance of a muscle explains.

**Detected** when, while the channel is on, the current exceeds duty × supply / 5 Ω by more than 50 mA for 2 ms
(`min_resistance_Ohm`, `current.off_A`, `short_ms`). The duty is averaged with the time constant of the current sense, so that both belong to
the same time. Behind a bus this is true only to within a tick, because the duty acts, or the current is read, at any moment between two ticks. There
`short_ms` is at least two ticks: after the end of a probe the current of the tick before exceeds the limit for one tick.

**Reaction:** the channel goes cold. The switch's own protection must be faster, because 2 ms is long for a transistor ([wiring](../wiring.md)).

## Likely causes

- turns of the muscle touch, or the muscle touches metal
- a wire is pinched
- **the power switch conducts by itself.** It then draws full current at a small duty, and shows as a short first.
  50 ms after the cut it becomes [heater_stuck_on](heater_stuck_on.md) for the board, while this channel keeps
  `heater_short` as its first cause
- `sense_filter_ms` does not match the sense: while the duty falls the current seems too high

## Remedy

1. If the board's fault is `heater_stuck_on`, continue on [its page](heater_stuck_on.md).
2. Supply off. Measure the muscle's resistance; below 5 Ω it is shorted. Move it while measuring.
3. If the resistance is right, compare `sense_filter_ms` with the board's filter.
4. Reset, arm.

## Margin

In amperes: the current beyond that of the lowest resistance, of 0.05 A. Normally it is negative: 0.36 A at a duty of 0.3 and 12 V is
0.36 − 0.72 = −0.36, used −7.2. A positive value is already part of the 50 mA.

## Not detected

- A resistance between 5 Ω and the right one. [resistance_drift](resistance_drift.md) sees it at the next probe.
- While off: that is heater_stuck_on.
- A short past the sense, which does not see that current.
"""


class HeaterStuckOn(FaultError):
    """Current flows although the channel is off. The one fault that software alone cannot cure: the power switch, or
whatever holds it, conducts by itself. So the heartbeat stops and the charge pump opens the supply of the whole board."""

    number = 22
    name = "heater_stuck_on"
    meaning = """\
Current flows although the channel is off. The one fault that software alone cannot cure: the power switch, or
whatever holds it, conducts by itself. So the heartbeat stops and the charge pump opens the supply of the whole board."""
    remedy = """\
1. Leave it off. Do not try a reset first: the supply is open, so there is no current and the reset is accepted. It
   starts the self-test, which closes the supply; a stuck switch then heats at full power for
   some 30 ms, until the test has failed: 2.5 K in a simulation. After that no reset helps, only a restart.
2. Supply off. Measure the power switch: drain to source must not conduct.
3. If it is good: what does the sense read with the muscle unplugged? Offset or filter.
4. Replace the switch. Then reset or restart: either way the self-test must prove both cuts before anything can be armed."""
    page = """\
# 22 heater_stuck_on

Current flows although the channel is off. **The one fault that software alone cannot cure**: the power switch, or
whatever holds it, conducts by itself. So the heartbeat stops and the charge pump opens the supply of the whole board.

**Detected** when the duty is 0 or the enable line low, and the current is above 50 mA, NaN, or not read at all, for 50 ms without
a gap (`current.off_A`, `stuck_on_ms`). Without a reading nothing proves that the heat is off. Only the current is proof, not what
the PWM reads back, which may be the kernel's memory. At the end of these 50 ms the current must also be more than an averaging
sense (`sense_filter_ms`) can still show of the current before, with a reserve of a quarter in the time constant: 32 mA after 50 ms
at 100 Hz, for 0.67 A and 10 ms. So a leak of little more than 50 mA may be found a few time constants later; a stuck switch is
found in time.

**Reaction:** every channel cold, heartbeat off, whatever other fault the channel has. If another was first, the channel
keeps that name; the other channels show this one. With the default decay of 20 ms the supply is open about 70 ms after
the switch stuck. The simulated muscle of 10 Ω at 12 V warms by 5.4 K in that time.

## Likely causes

- no current reading: a converter, its bus, its cable ([sensor_stale](sensor_stale.md) comes first)
- the power transistor failed to a short, as most do
- the gate driver or the enable gate failed
- the sense has an offset of more than 50 mA, or its filter is slower than `sense_filter_ms` says

## Remedy

1. Leave it off. **Do not try a reset first:** the supply is open, so there is no current and the reset is accepted. It
   starts the [self-test](self_test_failed.md), which closes the supply; a stuck switch then heats at full power for
   some 30 ms, until the test has failed: 2.5 K in a simulation. After that no reset helps, only a restart.
2. Supply off. Measure the power switch: drain to source must not conduct.
3. If it is good: what does the sense read with the muscle unplugged? Offset or filter.
4. Replace the switch. Then reset or restart: either way the self-test must prove both cuts before anything can be armed.

## Margin

In amperes: the current while off, of 0.05 A; infinite without a reading. Used 0.1 to 0.3 is an offset. While the
channel is on, it is not judged.

## Not detected

- Leaks of less than 50 mA: 0.6 W at 12 V, which warms the paper's muscle permanently by some 7 K. The estimate counts them from
  10 mA on.
- Current past the sense, or a sense that reads too little.
- While on: [heater_short](heater_short.md) or [power_limit_exceeded](power_limit_exceeded.md) must see it first.
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
   it may have until then.) Nothing from before the dither is used.
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
  the paper's muscle, 10 µm of noise, `pi` and `learned_ff`: a muscle that is not identified trips when its cooling doubles at 5 or 10 mm (12 of 12
  runs), but not when it grows by half. An identified one does not trip at 3, 5 or 10 mm (none of 36), because its responses prove that it is intact;
  before responses counted, 16 did. It may still trip if its cooling grows by a factor of 2.2, the largest that `[thermal]` allows by default (17 of
  96): at 3 mm, from 0.4 to 0.9 W, and at other positions if the draught begins 2 to 3 s before a window ends. The muscles of a [joint](../joints.md),
  and those that follow in a bundle, have no responses of their own.
- **Believed cooling that is wrong by a factor of two**, while the power falls slowly and the muscle is still warming: no model stands still, but the
  muscle does (1 of 75 groups of 20 runs, [safety](../safety.md#what-narrows-the-interval)).
"""


class DutyWrong(FaultError):
    """The PWM does not do what was set: it refuses a duty, or reads back another one."""

    number = 24
    name = "duty_wrong"
    meaning = """\
The PWM does not do what was set: it refuses a duty, or reads back another one."""
    remedy = """\
1. Look at the margin. About 10⁹ (2³⁰) stands for a refused write: check bus and chip.
2. A difference of a few steps that follows the duty means that the read-back lags.
3. With any other difference, find out which other program has the device open.
4. Check that no current flows. Only the current shows whether the enable line has worked.
5. Reset, arm."""
    page = """\
# 24 duty_wrong

The PWM does not do what was set: it refuses a duty, or reads back another one.

**Detected** when, for 5 ms, the last write was answered with an error, or the step that is read back differs from the
step that was set (`wrong_duty_ms`). A device that cannot be read back, or not while a write is under way (it answers
with a negative number), is judged by its errors alone. A write that failed is tried again at each tick.

**Reaction:** the channel goes cold: duty 0 is written, which may fail as well, and the enable line goes low. Here the enable line is the cut that counts.

## Likely causes

- the bus of an external PWM chip hangs, or the chip lost its supply
- another program writes to the same PWM
- a PWM behind a bus whose read back lags: while the duty changes at each tick it is never equal. Such a driver must
  answer that it cannot be read while its write is under way

## Remedy

1. Look at the margin. About 10⁹ (2³⁰) stands for a refused write: check bus and chip.
2. A difference of a few steps that follows the duty means that the read-back lags.
3. With any other difference, find out which other program has the device open.
4. Check that no current flows. Only the current shows whether the enable line has worked.
5. Reset, arm.

## Margin

In steps of the PWM: how far the step that is read back lies from the one that was set, and the limit is 0. Used is 0
if they are equal, otherwise infinite.

## Not detected

- A read back that is only the driver's memory of what was set (sysfs): it agrees with itself whatever the pin does.
- A wrong period or polarity.
- A PWM behind a bus whose duty changes at each tick: a write is always under way, and only its errors are judged.

If the enable line fails as well, the current goes on, and 50 ms later [heater_stuck_on](heater_stuck_on.md) opens the
supply.
"""


class LineFailed(FaultError):
    """An enable line or the heartbeat could not be set: the driver answered with an error. Both cuts depend on these lines, so none of them may be in doubt."""

    number = 25
    name = "line_failed"
    meaning = """\
An enable line or the heartbeat could not be set: the driver answered with an error. Both cuts depend on these lines, so none of them may be in doubt."""
    remedy = """\
1. Stop the firmware. Set each line by hand and measure at the gate and at the pump's input.
2. Find out which program holds the lines.
3. Start the firmware, or reset each channel: a line that failed is tried again at each tick, the heartbeat without an
   edge, so that the reset works once all obey. The self-test follows."""
    page = """\
# 25 line_failed

An enable line or the heartbeat could not be set: the driver answered with an error. Both cuts depend on these lines, so none of them may be in doubt.

**Detected** at the tick after the failed write; a single failure is enough.

**Reaction:** every channel cold, as far as its lines obey, and the heartbeat stops. If an enable line failed, the charge pump cuts the supply.

## Likely causes

- the line is held by another program, or was released
- the GPIO chip is gone: unloaded driver, expander on a bus
- missing rights

## Remedy

1. Stop the firmware. Set each line by hand and measure at the gate and at the pump's input.
2. Find out which program holds the lines.
3. Start the firmware, or reset each channel: a line that failed is tried again at each tick, the heartbeat without an
   edge, so that the reset works once all obey. The self-test follows.

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
    """The muscle may be hotter than it is allowed to be. Nobody measures its temperature: this is the upper end of an
estimated interval (safety)."""

    number = 30
    name = "over_temperature"
    meaning = """\
The muscle may be hotter than it is allowed to be. Nobody measures its temperature: this is the upper end of an
estimated interval (safety)."""
    remedy = """\
1. Compare the applied power with supply × current. If more is measured: heater_stuck_on.
2. Otherwise let it cool. The reset is refused until the estimate has fallen below the limit; it falls with the slowest
   time constant that the bounds allow, 4.4 s.
3. If it was really too hot, look at the muscle: permanently shortened, stiff, discoloured.
4. Change bounds only because of a measurement."""
    page = """\
# 30 over_temperature

The muscle may be hotter than it is allowed to be. Nobody measures its temperature: this is the upper end of an
estimated interval ([safety](../safety.md#temperature)).

**Detected** at once when the upper bound of the muscle's temperature is above 160 °C (`trip_C`), or is NaN. After boot it is judged from the first time on
that it was below the derating temperature. The bound is the warmest air (25 °C) plus the larger of two rises: that of the interval observer with
the configured bounds, and that of the observer with what was learned. Both are driven by the larger of the power that was set and the power that was
measured.

**Reaction:** the channel goes cold. Well before, from 130 °C on, the power is derated (limited by: temperature) and is
none at 160 °C.

## Likely causes

- a switch that conducts by itself: measured power far above what was set
- a `max_W` that is too large for the bounds: in the end the rise is at most max_W × 1.05 / 0.045 W/K, 105 K for 4.5 W, once the senses were compared

## Remedy

1. Compare the applied power with supply × current. If more is measured: [heater_stuck_on](heater_stuck_on.md).
2. Otherwise let it cool. The reset is refused until the estimate has fallen below the limit; it falls with the slowest
   time constant that the bounds allow, 4.4 s.
3. If it was really too hot, look at the muscle: permanently shortened, stiff, discoloured.
4. Change bounds only because of a measurement.

## Margin

In °C: the upper bound, of 160 °C. 112 of 160 is used 0.70 (of degrees Celsius, not of the rise). With the default bounds, compared senses, 4.5 W and a
switch that works it ends at 130 °C, used 0.81.

## Not detected

- Bounds that are wrong: another muscle, another medium, a blanket over it, air warmer than 25 °C.
- A hot spot: the estimate is for the whole muscle.
- Power beyond what was set by less than 10 mA × supply + 5 % (0.12 W while off): taken for the sense's error.
- The time from boot until the estimate falls below 130 °C, 1.1 s: how hot the muscle was before is unknown, and nothing
  can be armed.
"""


class OverTravel(FaultError):
    """The muscle has contracted further than it may."""

    number = 31
    name = "over_travel"
    meaning = """\
The muscle has contracted further than it may."""
    remedy = """\
1. Is the muscle really that short? If not, check sensor, zero and scale.
2. A reset is refused until the position is back below the limit. A muscle that lost its load may need a pull.
3. Look at the recording before the fault: a slope means that the muscle moved, a single point is a reading of the sensor.
4. Reset, arm."""
    page = """\
# 31 over_travel

The muscle has contracted further than it may.

**Detected** at once, by a single reading: the calibrated position is above 35 mm (`max_travel_m` of the channel), or is NaN. (In a scenario without a board's file that is 0.999 of the position sensor's range: 39.96 mm of 40.)
Readings that the sensor cannot give do not count: they are [sensor_out_of_range](sensor_out_of_range.md). A position command beyond the limit is
refused (out of range), so it cannot cause this fault.

**Reaction:** the channel goes cold.

## Likely causes

- a command `power`, which does not stop at any position
- overshoot of a badly tuned controller
- the load fell off, or broke
- in a joint: the muscle of the other side is torn, or its cable slack (below 0 the agonist's, above it the antagonist's); the fault comes
  within 0.1 s, after a motion that no heat caused
- a wrong zero or scale: `scale` with the wrong length, `calibrate` of a muscle that hangs on something
- one wild reading between `max_travel_m` and the end of the sensor's range: a single reading is enough here, unlike for [sensor_jump](sensor_jump.md)

## Remedy

1. Is the muscle really that short? If not, check sensor, zero and scale.
2. A reset is refused until the position is back below the limit. A muscle that lost its load may need a pull.
3. Look at the recording before the fault: a slope means that the muscle moved, a single point is a reading of the sensor.
4. Reset, arm.

## Margin

In metres: the position, of `max_travel_m`. With 0.035 a reference of 20 mm gives used 0.57. Negative positions give a negative number.

## Not detected

- Travel in the other direction: a muscle that is pulled too long is not judged.
- Anything without a fresh position ([sensor_stale](sensor_stale.md)), or beyond the sensor's range.
- Force. A muscle that is blocked does not travel and may pull hard: nothing here measures it.
"""


class EnergyBudgetExceeded(FaultError):
    """More energy went in, over about a minute, than the muscle may take. This is a second check of the heat that needs no thermal bounds."""

    number = 32
    name = "energy_budget_exceeded"
    meaning = """\
More energy went in, over about a minute, than the muscle may take. This is a second check of the heat that needs no thermal bounds."""
    remedy = """\
1. Let it rest. The account falls by 63 % in a minute; the reset is refused until it is below the limit.
2. Is the reference's mean power (the row's applied_W) what you planned?
3. Raise the budget only if the muscle's temperature allows it."""
    page = """\
# 32 energy_budget_exceeded

More energy went in, over about a minute, than the muscle may take. This is a second check of the heat that needs no thermal bounds.

**Detected** at once when the account passes `energy_J`: by default 1.1 `max_W` × `energy_window_s`, 297 J
for 4.5 W and 60 s. The account adds the largest power that may have been applied: the set power, the measured power if that is clearly more, or the
channel's maximum power if there is no current reading. It loses 1/60 of its content each second: a constant 4.95 W just fills it after a long time, 6.9 W
after 76 s, 14.4 W after 25 s.

**Reaction:** the channel goes cold.

**The default trips only when more flows than was asked for.** Holding `max_W` indefinitely does not trip it; then derating protects,
as far as the thermal bounds are true, and later controller_invalid. For muscles that may take a burst of power, but not permanently, set `energy_J` below
`max_W` × the window: with 240 J, 4.5 W trips after 132 s.

## Likely causes

- a budget that is smaller than the reference needs
- a command `power` for too long
- a switch that conducts by itself
- a stiffer load, or colder surroundings: the same motion takes more power

## Remedy

1. Let it rest. The account falls by 63 % in a minute; the reset is refused until it is below the limit.
2. Is the reference's mean power (the row's `applied_W`) what you planned?
3. Raise the budget only if the muscle's temperature allows it.

## Margin

In joules: the content of the account, of 297. At a mean of 2.5 W it settles at 150 J, used 0.51.

## Not detected

- Power beyond what was set by less than 10 mA × supply + 5 %: taken for the sense's error. While off: below 0.12 W.
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
2. Supply off, measure at the terminals, and at the muscle itself.
3. If the muscle is worn, replace it. 30 % more resistance is 30 % less silver on average; where the silver is thinnest, the thread gets hotter than
   the firmware can know.
4. If the new value is right, put it into the configuration (cold_resistance_Ohm), remove what was learned with the
   old one, and restart. calibrate cannot help: it needs an armed channel, and arming already ends in this fault."""
    page = """\
# 33 resistance_drift

The heater's resistance is far from its calibration. Silver wears off a muscle with use, so the resistance rises; turns
that touch lower it.

**Detected** when a probe ends: at each arming, in `calibrate`, and while active if the last resistance is older than 5 s, that is, at duties below the
probe's. The probe is a pulse of 2 % for 50 ms; its second half is measured. The result is compared with the calibrated cold resistance or, if the heater
has a coefficient, with that resistance at the temperature that fits best between the estimate's cold and hot end. More than 30 % either way trips (`resistance_ratio`). While
heating, the smoothed resistance is judged alike, and trips after 0.5 s: a sense that reads too little current would make
the power stage give more.
From four times the cold resistance on it is [heater_open](heater_open.md).

**Reaction:** the channel goes cold. Arming thus ends in `fault`, not in `armed`.

## Likely causes

- a worn muscle
- another muscle than the configuration says
- a contact with some ohms
- few steps of PWM or a coarse converter: at 2 % a 10 Ω muscle draws only 24 mA at 12 V

## Remedy

1. Look at the margin: how many ohms off?
2. Supply off, measure at the terminals, and at the muscle itself.
3. If the muscle is worn, replace it. 30 % more resistance is 30 % less silver on average; where the silver is thinnest, the thread gets hotter than
   the firmware can know.
4. If the new value is right, put it into the configuration (`cold_resistance_Ohm`), remove what was learned with the
   old one, and restart. `calibrate` cannot help: it needs an armed channel, and arming already ends in this fault.

## Margin

In ohms: the resistance, of the limit on its side of the calibration. 11.2 Ω for 10 Ω: 11.2 of 13, used 0.86; 8.8 Ω:
limit 7, used 0.8. A muscle as it was calibrated uses 0.77. It keeps the value of the last measurement, so watch how it grows over weeks.

## Not detected

- A change between probes, at duties that are too small to measure the resistance.
- With a coefficient, any change that a temperature within the interval explains. The wider the interval, the larger the change.
- Slow wear that is calibrated again and again: each calibration is the new base.
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
2. If it is right there, but the row's supply_V is wrong (0 means absent), check divider, converter and scaling.
3. If it is low under load only, check the supply and its wires.
4. Reset each channel. The first reset starts the self-test; when it has passed the heartbeat beats."""
    page = """\
# 40 under_voltage

The supply is too low, or it cannot be measured. No duty can be computed from an unknown supply.

**Detected** when the supply is below 10.8 V, or its reading is absent (older than 10 ms, or an error), for 20 ms
(`supply.min_V`, `supply.hold_ms`; the age is `max_age_ms` of the supply's input).

**Reaction:** every channel cold, heartbeat off. During the 20 ms before, the duty is already 0 if the reading is absent.

## Likely causes

- the supply is off. A board that is started without it has this fault 0.1 s after boot; the self-test waits
- the supply sags under load: it is too weak, its wires are long and thin, or its current is limited
- an empty battery
- the divider or the converter of the measurement

## Remedy

1. Measure at the board's terminals, with all channels active.
2. If it is right there, but the row's `supply_V` is wrong (0 means absent), check divider, converter and scaling.
3. If it is low under load only, check the supply and its wires.
4. Reset each channel. The first reset starts the self-test; when it has passed the heartbeat beats.

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
    """The supply is above what the board is made for."""

    number = 41
    name = "over_voltage"
    meaning = """\
The supply is above what the board is made for."""
    remedy = """\
1. Measure at the terminals before anything is reset.
2. If it is too high, replace the supply. Raise the limit only if transistors, capacitors and pump are made for it.
3. If it is right, the scaling is wrong. Then every power was wrong as well: too low if the supply reads too high. Correct the scaling.
4. Reset each channel."""
    page = """\
# 41 over_voltage

The supply is above what the board is made for.

**Detected** when it reads more than 13.2 V for 20 ms (`supply.max_V`, `supply.hold_ms`).

**Reaction:** every channel cold, heartbeat off: the supply switch opens and keeps the voltage from the power switches, but not from parts that are
wired before it.

Below the limit a muscle's power does not rise with the voltage, because the duty follows the measured supply.

## Likely causes

- a wrong or wrongly adjusted supply
- an unregulated supply without load
- something feeds back into the supply, such as a motor
- the divider of the measurement

## Remedy

1. Measure at the terminals **before** anything is reset.
2. If it is too high, replace the supply. Raise the limit only if transistors, capacitors and pump are made for it.
3. If it is right, the scaling is wrong. Then every power was wrong as well: too low if the supply reads too high. Correct the scaling.
4. Reset each channel.

## Margin

In volts. 12.0 of 13.2 V, used 0.91. The rows carry `supply_V` itself.

## Not detected

- Spikes shorter than 20 ms: use a suppressor on the board.
- A supply that cannot be measured: that is [under_voltage](under_voltage.md).
- A converter that clips below the limit. Its full scale must lie well above 13.2 V.
"""


class PowerLimitExceeded(FaultError):
    """The channel draws more power than can have been asked for."""

    number = 42
    name = "power_limit_exceeded"
    meaning = """\
The channel draws more power than can have been asked for."""
    remedy = """\
1. Compare applied_W with supply × current in the recording. If they agree until the end, the two limits do not fit each other.
2. If they differ by a constant factor, it is a scaling. Check the sense with a known resistor.
3. If they diverge suddenly, check the switch, with the supply off.
4. Reset, arm."""
    page = """\
# 42 power_limit_exceeded

The channel draws more power than can have been asked for.

**Detected** when supply × averaged current is above 1.25 `max_W` + 0.3 W (5.9 W for 4.5 W), or NaN, for 100 ms (`max_measured_W`, `over_power_ms`).
It is judged in every state, also while off.

**Reaction:** the channel goes cold. If the current goes on, [heater_stuck_on](heater_stuck_on.md) follows 50 ms later
and opens the supply.

## Likely causes

- a switch that conducts by itself while the duty is high (at a low duty [heater_short](heater_short.md) is faster)
- the resistance from which the duty was computed is too high: the true one is lower, so more power flows
- `max_W` was raised, but `max_measured_W` was not: it must exceed max_W by the errors of measurement
- sense or supply is scaled wrongly

## Remedy

1. Compare `applied_W` with supply × current in the recording. If they agree until the end, the two limits do not fit each other.
2. If they differ by a constant factor, it is a scaling. Check the sense with a known resistor.
3. If they diverge suddenly, check the switch, with the supply off.
4. Reset, arm.

## Margin

In watts: measured power, of 5.9 W. 4.5 W is used 0.76.

## Not detected

- Power with the sense or the supply reading too low.
- Bursts of less than 100 ms. In 100 ms, 14.4 W (12 V on 10 Ω) warm the paper's muscle by some 9 K.
- Without a current reading.
"""


class Overrun(FaultError):
    """The firmware does not get its ticks done in time."""

    number = 50
    name = "overrun"
    meaning = """\
The firmware does not get its ticks done in time."""
    remedy = """\
1. supercoil doctor: each warning about kernel, priority, memory or clock comes with its remedy.
2. Stop supercoild and run supercoild --latency --config board.toml. It runs the same ticks without devices. If they are long
   or late there too, the cause is priority, processor or memory (real time).
3. If they are short there, compare with execution_s of Timing on the running board, which the page
   shows. If that is much longer already while all channels are disarmed, a device is too slow to be
   direct.
4. If it becomes long only when channels are active, lower rate_Hz, or use fewer channels or simpler controllers.
5. Reset each channel; the self-test follows."""
    page = """\
# 50 overrun

The firmware does not get its ticks done in time.

**Detected** when 5 periods were left out without a punctual tick between them (`overruns_in_a_row`): in several short
overruns in a row, or in one stall. After an overrun whole periods are left out; two ticks never run back to back. One
punctual tick sets the count back to 0.

**Reaction:** every channel cold, heartbeat off.

During the stall the charge pump protects: when no edge comes for its decay time, it opens the supply, whatever the
firmware does. The decay must exceed twice the tolerated overruns, or the configuration is refused: with 5 periods of 1 ms it
must be longer than 10 ms. So a stall that opens the supply is always a fault as well, and nothing heats again by itself.

Periods that were left out count for all hold times, for the expiry of commands and for the temperature estimate, up to
1000 of them.

## Likely causes

- something else at a higher or equal priority, or interrupts on the same core
- page faults, a debugger, a suspended machine
- too many channels or too costly laws for the rate
- a direct device that takes longer than 20 µs

## Remedy

1. `supercoil doctor`: each warning about kernel, priority, memory or clock comes with its remedy.
2. Stop supercoild and run `supercoild --latency --config board.toml`. It runs the same ticks without devices. If they are long
   or late there too, the cause is priority, processor or memory ([real time](../realtime.md)).
3. If they are short there, compare with `execution_s` of [Timing](../can-protocol.md#timing) on the running board, which the page
   shows. If that is much longer already while all channels are disarmed, a device is too slow to be
   [direct](../porting.md#direct-or-behind-a-bus).
4. If it becomes long only when channels are active, lower `rate_Hz`, or use fewer channels or simpler controllers.
5. Reset each channel; the self-test follows.

## Margin

A count of periods, of 5. `overruns` of [Timing](../can-protocol.md#timing) counts all periods that were left out since boot.

## Not detected

- Overruns that are never 5 periods in a row. Controllers and filters are computed for whole steps, and tracking
  suffers; the protection counts the time.
"""


class TickLate(FaultError):
    """The loop wakes later than it asked for. The ticks still end in time, but their timing is not the one for which filters and
controllers were computed."""

    number = 51
    name = "tick_late"
    meaning = """\
The loop wakes later than it asked for. The ticks still end in time, but their timing is not the one for which filters and
controllers were computed."""
    remedy = """\
1. supercoil doctor: each warning about kernel, priority, memory or clock comes with its remedy.
2. Stop supercoild and run supercoild --latency --config board.toml --plot latency.svg. If all ticks are late by the same amount,
   suspect a power-saving state; a few ticks that are very late point to another thread or to interrupts.
3. Give the loop its own core, a real-time priority, and locked memory (real time).
4. Raise late_ms only when the maximum is explained.
5. Reset each channel."""
    page = """\
# 51 tick_late

The loop wakes later than it asked for. The ticks still end in time, but their timing is not the one for which filters and
controllers were computed.

**Detected** when 5 ticks in a row woke more than 0.5 ms after their time (`late_ms`, `late_in_a_row`).

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
4. Raise `late_ms` only when the maximum is explained.
5. Reset each channel.

## Margin

A count of ticks, of 5. How late the ticks are is `late_s` of [Timing](../can-protocol.md#timing), the maximum since the frame
before.

## Not detected

- Single late ticks, however late, and any pattern with a punctual tick in between. Timing shows them.
- A clock that runs fast or slow.
"""


class TelemetryDead(FaultError):
    """The telemetry thread has stopped. The board can no longer be watched, and commands may not come through;
so nothing should be hot."""

    number = 52
    name = "telemetry_dead"
    meaning = """\
The telemetry thread has stopped. The board can no longer be watched, and commands may not come through;
so nothing should be hot."""
    remedy = """\
1. Is the process still there, with all its threads? What does the thread wait for?
2. If it only comes late, find what keeps the machine busy; a disk or a bus that blocks must not be in that thread.
3. Restart the firmware: a thread that has ended does not come back by a reset.
4. If the thread is alive again by itself, reset each channel."""
    page = """\
# 52 telemetry_dead

The telemetry thread has stopped. The board can no longer be watched, and commands may not come through;
so nothing should be hot.

**Detected** when the counter that the thread increments has not changed for 0.5 s (`telemetry_timeout_ms`). It must count from
boot on.

**Reaction:** every channel cold, heartbeat off.

## Likely causes

- the thread has ended, or hangs in a call that blocks
- the thread is starved: too low a priority on a busy machine
- a program of your own that runs the loop and does not increment `Health::telemetry_heartbeats`

## Remedy

1. Is the process still there, with all its threads? What does the thread wait for?
2. If it only comes late, find what keeps the machine busy; a disk or a bus that blocks must not be in that thread.
3. Restart the firmware: a thread that has ended does not come back by a reset.
4. If the thread is alive again by itself, reset each channel.

## Margin

In seconds: how long the counter has stood, of 0.5 s.

## Not detected

- A thread that increments its counter and does nothing else.
- Lost telemetry. Rows that found no room are counted and reported in the log; that is no fault.
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
2. Send every 50 to 80 ms, even if nothing changes.
3. Stop sending before you reset: commands to heat are refused now, and ten refused ones in a row keep the reset from
   working (command_not_allowed).
4. Reset, arm, command."""
    page = """\
# 60 command_timeout

The master has fallen silent: every command to heat expires unless it is renewed.

**Detected** when a channel has been active for more than 0.25 s without a renewal (`command.timeout_ms`). `position`,
`power` and `renew` renew; `identify` and `calibrate` only when they start, so they need `renew` while they run.
Periods that were left out after an [overrun](overrun.md) count: no command was renewed in them.

**Reaction:** the channel goes cold. At full power (4.5 W) the paper's muscle warms by some 7 K in that time.

## Likely causes

- the commanding program ended, hangs, or lost its connection
- it stopped with its last command still in force: end with `rest` or `disarm`
- it renews too rarely: leave room for three renewals within 0.25 s
- it renews another channel

## Remedy

1. Find out what the sender was doing at the time of the fault.
2. Send every 50 to 80 ms, even if nothing changes.
3. Stop sending before you reset: commands to heat are refused now, and ten refused ones in a row keep the reset from
   working ([command_not_allowed](command_not_allowed.md)).
4. Reset, arm, command.

## Margin

In seconds: the age of the last renewal, of 0.25 s. 0.06 of 0.25 is used 0.24. The maximum over a day says how
close the connection is to failing. While nothing is active it is 0.

## Not detected

- A program that hangs in the part that decides, but not in the part that renews.
- A wrong command that is renewed.
"""


class CommandDamaged(FaultError):
    """Commands arrive with a wrong checksum or a counter that does not follow."""

    number = 61
    name = "command_damaged"
    meaning = """\
Commands arrive with a wrong checksum or a counter that does not follow."""
    remedy = """\
1. If all channels on the bus have it, the cause is the bus; if one channel has it, its sender.
2. Stop all senders but one.
3. Check termination and wiring of the bus.
4. Reset, arm. If damaged commands still arrive, the fault returns within ten of them."""
    page = """\
# 61 command_damaged

Commands arrive with a wrong checksum or a counter that does not follow.

**Detected** at the tenth tick in a row in which a damaged command came (`damaged_in_a_row`). Ticks without any command do not count; a tick with only
intact commands resets the count. Damaged commands are never obeyed.

**Reaction:** the channel goes cold.

Only commands over CAN are checked ([can.md](../can.md#commanding)). A tick with both an intact and a damaged command counts as damaged.

## Likely causes

- a bus with wrong termination, or too long
- two senders on one channel, whose counters do not fit together
- a sender of another version of the protocol

## Remedy

1. If all channels on the bus have it, the cause is the bus; if one channel has it, its sender.
2. Stop all senders but one.
3. Check termination and wiring of the bus.
4. Reset, arm. If damaged commands still arrive, the fault returns within ten of them.

## Margin

A count, of 10. Used 0.3 means three damaged ones in a row. The count does not change while nothing is heard.

## Not detected

- Damage that leaves the checksum right: one in 256 of errors of 4 bits or more.
- Damage to every second command: the count never reaches 10. But then the intact commands are obeyed.
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
1. Stop the stream first. The count stays at its limit while refused commands come: a reset among them is not obeyed, and is answered
   'cause persists'.
2. Send reset, alone in its tick and not in the tick after another one.
3. Let the sender read the channel's state: send commands to heat only when it is armed or active.
4. Find the other sender, if there is one."""
    page = """\
# 62 command_not_allowed

A program keeps sending commands that the channel's state does not allow. Sender and board disagree about what the channel is
doing.

**Detected** at the tenth tick in a row with a command that was refused as "wrong state" (`refused_in_a_row`). Ticks
without a command do not count; a tick with other answers only resets the count. Refusals for other reasons (out of range,
busy, not ready) do not count either.

**Reaction:** the channel goes cold. Most often it is cold already; then it only changes from `disarmed` to `fault`.

## Likely causes

- a stream of `position` or `power` that starts before the channel is armed
- a stream, or `renew`, that goes on after `rest`, `disarm`, or another fault
- two programs that command the same channel

## Remedy

1. **Stop the stream first.** The count stays at its limit while refused commands come: a reset among them is not obeyed, and is answered
   "cause persists".
2. Send `reset`, alone in its tick and not in the tick after another one.
3. Let the sender read the channel's state: send commands to heat only when it is `armed` or `active`.
4. Find the other sender, if there is one.

## Margin

A count, of 10. It does not change while no command comes. An occasional 0.1 to 0.3 means that the sender lags a little behind the
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
4. If it is not pressed, measure the loop: the input is high when the loop is closed."""
    page = """\
# 63 emergency_stop

The emergency stop is pressed, its circuit is broken, or its input cannot be read. The firmware treats all three alike.

**Detected** at once: the input is read at each tick, and anything but "high, read without an error" trips.

**Reaction:** every channel cold and the heartbeat off in the same tick; the supply opens after the pump's decay, 20 ms.
The fault stays when the stop is released. While the stop is pressed, the self-test does not run; if it is pressed during the self-test, the test ends in
the same tick. In the first 0.1 s after boot nothing is latched, but everything is off.

## Likely causes

- somebody pressed it. Ask why before you release it
- a wire of the loop is broken, a plug is open
- the input's line is not held by the firmware

## Remedy

1. Make sure that the reason for pressing it is gone.
2. Release the button; the input must read high.
3. Reset each channel. The first reset starts the self-test, 0.23 s; then arm.
4. If it is not pressed, measure the loop: the input is high when the loop is closed.

## Margin

A flag: 0 is closed, 1 is open, the limit is 0.

## Not detected

- A wire shorted to the level "high".
- **A stop that only the firmware reads is not a stop.** Its contacts must also break the supply or the pump's input by
  themselves: [wiring](../wiring.md).
"""


class BusOff(FaultError):
    """The CAN controller has left the bus: it saw so many errors of its own that it went silent, as the standard demands. Or its interface is down, which is
the same for the board."""

    number = 70
    name = "bus_off"
    meaning = """\
The CAN controller has left the bus: it saw so many errors of its own that it went silent, as the standard demands. Or its interface is down, which is
the same for the board."""
    remedy = """\
1. Bus unpowered, measure between CAN-H and CAN-L: 60 Ω.
2. Compare the bit rates of all nodes.
3. Unplug nodes one by one.
4. When the controller is back on the bus, reset each channel."""
    page = """\
# 70 bus_off

The CAN controller has left the bus: it saw so many errors of its own that it went silent, as the standard demands. Or its interface is down, which is
the same for the board.

**Detected** at the tick at which the telemetry thread reports it (`can_bus_off_ms` is 0: at once).

**Reaction:** every channel goes cold. The heartbeat continues, because a bus is no reason to doubt the switches. Therefore its scope in the table is
`channel`, although it affects all channels. Any fault of the board, such as the emergency stop or a stuck switch, still stops the heartbeat. While the
fault lasts, no self-test begins and no fault of the board can be reset.

`supercoild` reports the state of the interface in `[can]`; without `[can]`, and in the simulation, it stays "active".

## Likely causes

- CAN-H and CAN-L swapped or shorted
- a wrong bit rate
- no termination, or only one of two
- the interface was never brought up, or was taken down
- no other node: no acknowledge (that leads to [bus_error_passive](bus_error_passive.md) first)

## Remedy

1. Bus unpowered, measure between CAN-H and CAN-L: 60 Ω.
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
1. Alone on the bus? Connect a second node, or do not use the bus.
2. Termination: 60 Ω between CAN-H and CAN-L, at the ends and nowhere else.
3. Look at the controller's error counters: transmit errors without receive errors mean that no node receives.
4. Reset each channel once the counters fall."""
    page = """\
# 71 bus_error_passive

The CAN controller sees so many errors that it no longer marks them on the bus ("error passive"). It still works; the
next step is [bus_off](bus_off.md).

**Detected** when the state is error-passive, bus-off or down for 1 s without a gap (`can_error_passive_ms`). Bus-off is
found earlier, as a fault of its own.

**Reaction:** as for bus_off: every channel goes cold, and the heartbeat continues. While the fault lasts, no self-test begins and no fault of the board can
be reset.

Without `[can]` in the configuration, and in the simulation, this fault cannot appear.

## Likely causes

- the board is alone on its bus: no node acknowledges. Typical on a bench
- termination or wiring that is nearly right
- interference: a motor's cable beside the bus
- a bit rate that is slightly off

## Remedy

1. Alone on the bus? Connect a second node, or do not use the bus.
2. Termination: 60 Ω between CAN-H and CAN-L, at the ends and nowhere else.
3. Look at the controller's error counters: transmit errors without receive errors mean that no node receives.
4. Reset each channel once the counters fall.

## Margin

In seconds: how long it has been passive, of 1 s. Short spells that never reach 1 s show a bus that is
close to failing.

## Not detected

- Errors below the controller's own limit of 128.
"""


class NodeConflict(FaultError):
    """Another board on the CAN bus has a node of this board. Both would obey each other's masters, and their telemetry would
mix. Neither can know whose node it is, so both boards go cold."""

    number = 72
    name = "node_conflict"
    meaning = """\
Another board on the CAN bus has a node of this board. Both would obey each other's masters, and their telemetry would
mix. Neither can know whose node it is, so both boards go cold."""
    remedy = """\
1. supercoil monitor with one of the boards unplugged shows which nodes are taken.
2. Give each board its own first_node in [can](../configuration.md#can), and restart it.
3. Reset each channel of the board that kept its nodes."""
    page = """\
# 72 node_conflict

Another board on the CAN bus has a node of this board. Both would obey each other's masters, and their telemetry would
mix. Neither can know whose node it is, so both boards go cold.

**Detected** when the heartbeat (Status) of one of this board's own nodes is heard from another sender: at the tick after
the telemetry thread reads it. A board sends its heartbeat 10 times a second (at least once), so two boards find each
other within 0.1 s (1 s). The fault's cause lasts 2.5 s after the last such frame. Frames that this board sent itself are
never among them: the kernel does not hand them back to the socket that sent them.

**Reaction:** every channel cold, as for [bus_off](bus_off.md), and the heartbeat of the charge pump goes on: a wrong
address is no reason to doubt the switches. While the conflict lasts, no self-test begins and nothing can be reset or
armed: a board does not start if its nodes are taken.

## Likely causes

- two boards with the same `first_node`, or with ranges of nodes that overlap
- a copied SD card
- a log that is played to a bus with its own board (`canplayer`)

## Remedy

1. `supercoil monitor` with one of the boards unplugged shows which nodes are taken.
2. Give each board its own `first_node` in [`[can]`](../configuration.md#can), and restart it.
3. Reset each channel of the board that kept its nodes.

## Margin

0, and 1 while another board is heard.

## Not detected

- A board whose control loop stands still: it sends no heartbeat.
- Two boards with one node on two buses that are not connected.
- A sender that forges this node's heartbeat makes it cold, as a `disarm` would.
"""


class ConfigurationInvalid(FaultError):
    """The configuration is no longer the one that the firmware was started with."""

    number = 80
    name = "configuration_invalid"
    meaning = """\
The configuration is no longer the one that the firmware was started with."""
    remedy = """\
1. Compare the file with the version that you trust.
2. If the change is meant: check it, and restart the firmware. A running firmware does not take over a configuration.
3. If it was not edited: check the disk before you trust the board again.

A reset works only once the program reports that the file is as it was."""
    page = """\
# 80 configuration_invalid

The configuration is no longer the one that the firmware was started with.

**Detected** at the tick after another thread of the program reports it. `supercoild` does not watch its file, so there this
fault cannot appear: it is for programs of your own that run the loop (`Health::configuration_changed`).

**Reaction:** every channel cold, heartbeat off.

Settings that are wrong from the beginning do not lead here: supercoild names each mistake and does not start.

## Likely causes

- the file was edited while the board ran
- a package was updated under the running firmware
- a failing disk: the file was read differently

## Remedy

1. Compare the file with the version that you trust.
2. If the change is meant: check it, and restart the firmware. A running firmware does not take over a configuration.
3. If it was not edited: check the disk before you trust the board again.

A reset works only once the program reports that the file is as it was.

## Margin

A flag: 0 is unchanged, 1 changed, the limit is 0.

## Not detected

- Values that are valid and wrong: thermal bounds of another muscle, another resistance. **Nothing finds these.**
"""


class ControllerInvalid(FaultError):
    """The controller has failed: its demand is NaN, or it has demanded more than it can get for two minutes."""

    number = 81
    name = "controller_invalid"
    meaning = """\
The controller has failed: its demand is NaN, or it has demanded more than it can get for two minutes."""
    remedy = """\
1. If the margin is in seconds (120 of 120), the demand was limited. Look at limited_by in the recording: which limit, and for how long?
2. If it was the maximum, ask for less, or allow more power if the muscle may have it. If it was temperature or unproven, ask for no more than can be held
   permanently (supercoild --check), or set shape_reference.
3. If it was NaN, look at the estimates before the fault, go back to a simpler controller, and identify again.
4. Reset, arm. A controller starts afresh when it is activated."""
    page = """\
# 81 controller_invalid

The controller has failed: its demand is NaN, or it has demanded more than it can get for two minutes.

**Detected** in two ways:
- The demanded power is NaN or infinite: found at the next tick. In the tick itself the limiter already gives 0 W
  (limited by: invalid).
- More was demanded than was given for 120 s without a gap while active (`saturated_s`), whichever limit reduced it: maximum,
  temperature, slew, supply. A demand below 0 W does not count: that is how a muscle cools.

**Reaction:** the channel goes cold.

## Likely causes

- NaN: gains that diverge, a learned parameter that became absurd
- a position that 4.5 W cannot reach: too much load, a softer muscle
- a set point that stays above the travel that can be held permanently, without `shape_reference`
- a command `power` above `max_W`
- a supply that is too weak for the demanded power

## Remedy

1. If the margin is in seconds (120 of 120), the demand was limited. Look at `limited_by` in the recording: which limit, and for how long?
2. If it was the maximum, ask for less, or allow more power if the muscle may have it. If it was temperature or unproven, ask for no more than can be held
   permanently (`supercoild --check`), or set [`shape_reference`](../control.md#references-that-a-muscle-can-follow).
3. If it was NaN, look at the estimates before the fault, go back to a simpler controller, and `identify` again.
4. Reset, arm. A controller starts afresh when it is activated.

## Margin

In seconds: for how long it has demanded more than it got, of 120 s. After NaN, measured is NaN and used is infinite.

## Not detected

- A controller that oscillates or tracks badly within its limits.
- A limited demand with a single tick without limit in every two minutes.
- A controller that demands less than 0 W permanently.
"""


class SelfTestFailed(FaultError):
    """The board could not prove that it can cut the heat. It never gets armed."""

    number = 82
    name = "self_test_failed"
    meaning = """\
The board could not prove that it can cut the heat. It never gets armed."""
    remedy = """\
1. Look which cut failed: measured of the fault is 1 for the supply switch with its pump, and 2 for an enable line or a power
   switch. The page and supercoil log --summary show it, and a bus has it in
   FirstCause.
2. Unplug the muscles. A sense that does not read 0 has an offset.
3. If it is 1, stop the firmware and measure behind the supply switch: there must be no voltage.
4. If it is 2, set a duty with the enable line low: it must not reach the gate.
5. Restart. A reset does not help: a test that has failed stays failed."""
    page = """\
# 82 self_test_failed

The board could not prove that it can cut the heat. It never gets armed.

**Detected** in the self-test: at every boot, and again after every reset of a board's fault. It takes 0.23 s. Twice a
pulse of the probe's duty (2 %, 30 ms) is set while one of the two switches may conduct and the other is off:

| from | heartbeat | enable | duty | a current means |
|---|---|---|---|---|
| 0 | stands still | low | 0 | nothing yet: the last life may have pumped until just now |
| 0.07 s | stands still | high | 2 % | the pump, or the supply's switch, does not open |
| 0.10 s | beats | low | 0 | the power switch, or its gate, conducts by itself |
| 0.15 s | beats | low | 2 % | the enable line does not cut |
| 0.18 to 0.23 s | beats | low | 0 | as at 0.10 s |

It fails when, from 0.07 s on and whether a pulse is on or not, any channel shows more than the smaller of
`current.off_A` (50 mA) and half of what the probe should draw at the lowest supply (10.8 mA for 10 Ω and 10.8 V) for
a pulse's second half on average, or four times as much for more than 9 ms at any time of the test.

**It waits,** with every line low, until the supply is within its limits, the stop circuit is closed, every channel has
a current reading and the board has no fault (a bus fault counts as well). When one of these is lost it stops in that
tick, and starts again later. What is missing becomes its own fault 0.1 s after boot, for example
[under_voltage](under_voltage.md); once it is there again, a reset starts the test.

**Reaction:** every channel goes to `fault`, the heartbeat stays off.

## Likely causes

- the supply's switch is stuck closed, or the pump is bridged
- the pump decays more slowly than `charge_pump_decay_ms`, or another program beats
- an enable gate that does nothing; a power switch that conducts by itself
- the sense has an offset of more than 10.8 mA

## Remedy

1. Look which cut failed: `measured` of the fault is 1 for the supply switch with its pump, and 2 for an enable line or a power
   switch. The page and `supercoil log --summary` show it, and a bus has it in
   [FirstCause](../can-protocol.md#firstcause).
2. Unplug the muscles. A sense that does not read 0 has an offset.
3. If it is 1, stop the firmware and measure behind the supply switch: there must be no voltage.
4. If it is 2, set a duty with the enable line low: it must not reach the gate.
5. Restart. A reset does not help: a test that has failed stays failed.

## Margin

0: passed. 1: failed, because the supply switch does not open when the heartbeat stops. 2: failed, because an enable line does not
cut, or a power switch conducts by itself. The limit is 0.

## Not detected

- Nothing can flow anyway: no muscle, a sense that reads 0, a fuse gone behind the measurement of the supply. The test
  then passes and has proved nothing; arming fails as [heater_open](heater_open.md).
- A way of cutting that fails later, until the next test.
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
