// Motions that the board buffers ahead of time: knots, each with its time, position and velocity.

import { LENGTH } from "./joint.js";
import { waveform } from "./waveform.js";

const STEP_S = 0.04;
const FAST_STEP_S = 0.02; // if 25 knots a second would be fewer than 10 a period
const MIN_PERIOD_S = 0.2;
const MAX_STEP_S = 4.094; // that a knot can carry

/** Why a shape cannot be a trajectory, or "". values: the shape's, without a file's rows. */
export function jumps(shape, values) {
  if (shape === "steps") return "it jumps";
  const min_s = Math.min(values.period, shape === "chirp" ? values.last_period : Infinity);
  return min_s < MIN_PERIOD_S ? `a period of less than ${MIN_PERIOD_S} s has too few knots` : "";
}

/** From 0 to 1, starting and ending at rest, without a jump in acceleration. */
function ease(part) {
  const p = Math.min(1, Math.max(0, part));
  return p ** 3 * (10 - 15 * p + 6 * p ** 2);
}

const in_ms = (time_s) => Math.round(1e3 * time_s) / 1e3;

/** {at, end_s, knots()}: a swing that grows within its first period; a chirp also fades within its last one. */
export function swinging(shape, values, measure = LENGTH) {
  const wave = waveform(shape, values, measure);
  const middle_m = measure.to_m(values.offset);
  const { period, last_period } = values;
  const fade = (time_s) => ease(time_s / period) * (shape === "chirp" ? ease((wave.end_s - time_s) / last_period) : 1);
  const at = (time_s) => middle_m + fade(time_s) * (wave.at(time_s) - middle_m);
  const min_s = Math.min(period, shape === "chirp" ? last_period : Infinity);
  const step_s = min_s < 10 * STEP_S ? FAST_STEP_S : STEP_S;
  const end_s = in_ms(wave.end_s);
  return { at, end_s, knots: () => swing_knots(at, step_s, end_s) };
}

function* swing_knots(at, step_s, end_s) {
  const near_s = 1e-3;
  yield { time_s: 0, position_m: at(0), velocity_m_per_s: 0 };
  for (let i = 1; i * step_s < end_s - step_s / 2; ++i) {
    const time_s = in_ms(i * step_s);
    yield { time_s, position_m: at(time_s), velocity_m_per_s: (at(time_s + near_s) - at(time_s - near_s)) / (2 * near_s) };
  }
  yield { time_s: end_s, position_m: at(end_s), velocity_m_per_s: 0 };
}

/** The same for a file's rows [s, m], which the trajectory passes smoothly; {why} if they are too far apart. */
export function through(rows, at) {
  const kept = [];
  for (const [time_s, position_m] of rows) {
    const knot = { time_s: in_ms(time_s - rows[0][0]), position_m };
    if (kept.length === 0 || knot.time_s - kept.at(-1).time_s > FAST_STEP_S - 5e-4) kept.push(knot);
    else if (time_s === rows.at(-1)[0] && kept.length > 1) kept[kept.length - 1] = knot;
  }
  if (kept.length < 2) return { why: `it lasts less than ${FAST_STEP_S} s` };
  if (kept.some(({ time_s }, i) => i > 0 && time_s - kept[i - 1].time_s > MAX_STEP_S)) return { why: `rows are more than ${MAX_STEP_S} s apart` };
  kept.forEach((knot, i) => (knot.velocity_m_per_s = i === 0 || i === kept.length - 1 ? 0 : velocity(kept[i - 1], knot, kept[i + 1])));
  return { at, end_s: kept.at(-1).time_s, knots: () => kept.values() };
}

/** From the parabola through three knots, at the middle one. */
function velocity(before, knot, after) {
  const [since_s, until_s] = [knot.time_s - before.time_s, after.time_s - knot.time_s];
  const [reached, left] = [(knot.position_m - before.position_m) / since_s, (after.position_m - knot.position_m) / until_s];
  return (reached * until_s + left * since_s) / (since_s + until_s);
}
