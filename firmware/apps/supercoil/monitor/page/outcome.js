// What happened in the time shown: power limits, an infeasible reference, a channel that was never armed, a sustained
// oscillation.

import { fixed, significant, words } from "./format.js";
import { refusal_words } from "./refusals.js";

// Searches for a self-sustained oscillation only in the newest part, while the reference is constant.
const WINDOW_S = 60;
const STILL_M = 1e-5;
const MIN_PERIODS = 4;
const MIN_SHARE = 0.0005; // else 0.0 %
// Max ratio of the periods' spread to their mean: noise crosses without a rhythm.
const MAX_SPREAD_RATIO = 0.2;
// In a loop that oscillates from limit to limit most cycles have similar lengths, at most a third of the reference's own period.
const MIN_CYCLES = 12;
const SIMILAR_RATIO = 0.25;
const MAX_PERIOD_RATIO = 1 / 3;

/** [time, value, …] of some columns of a table. */
function* samples(table, columns, from_s, to_s) {
  const places = columns.map((column) => table?.columns.indexOf(column));
  for (const chunk of table?.chunks ?? []) {
    if (chunk.last_s < from_s || chunk.first_s > to_s) continue;
    for (let row = chunk.lower_bound(from_s); row < chunk.count && chunk.time_s[row] <= to_s; ++row)
      yield [chunk.time_s[row], ...places.map((place) => chunk.values[place][row])];
  }
}

const number_of = (store, message, signal, name) => Number(Object.entries(store.protocol[message]?.[signal]?.values ?? {}).find(([, is]) => is === name)?.[0]);

/** [time, name] of the limit on the power; null while the channel was not active or, if modes are given, not in any. */
function* limits(store, node, { from_s, to_s }, modes = []) {
  const active = number_of(store, "Status", "state", "active"), wanted = modes.map((mode) => number_of(store, "Status", "mode", mode));
  const states = [...samples(store.table(node, "Status"), modes.length > 0 ? ["state", "mode"] : ["state"], from_s, to_s)];
  let place = 0;
  for (const [time_s, by] of samples(store.table(node, "Power"), ["limited_by"], from_s, to_s)) {
    while (place < states.length - 1 && states[place + 1][0] <= time_s) ++place;
    const [, state, mode] = states[place] ?? [];
    const counts = state === active && (modes.length === 0 || wanted.includes(mode));
    yield [time_s, counts ? store.word("Power", "limited_by", by) : null];
  }
}

const percent = (count, all) => `${fixed((100 * count) / all, 1)} %`;

/** "at a limit in 12.3 % of the heating time: maximum 10.0 %, slew 2.3 %", or "". */
export function limits_text(store, node, range) {
  const counts = new Map();
  let all = 0;
  for (const [, name] of limits(store, node, range)) {
    if (name === null) continue;
    ++all;
    counts.set(name, (counts.get(name) ?? 0) + 1);
  }
  const names = [...counts].filter(([name, count]) => name !== "nothing" && count / all >= MIN_SHARE).sort((a, b) => b[1] - a[1]);
  if (names.length === 0) return "";
  const sum = names.reduce((total, [, count]) => total + count, 0);
  return `At a limit in ${percent(sum, all)} of the heating time: ${names.map(([name, count]) => `${words(name)} ${percent(count, all)}`).join(", ")}.`;
}

/** Reports a reference that the muscle, by itself or as a joint's antagonist, cannot follow, counted as in the simulator's summary; or "". rule: infeasible of /api/about. */
export function infeasible_text(store, node, range, rule) {
  const too_much = new Set(rule.limits);
  let all = 0;
  let missed = 0;
  let max_s = 0;
  let in_a_row = 0;
  let since_s = null;
  let shaped = false;
  for (const [time_s, name] of limits(store, node, range, ["position", "joint"])) {
    if (name !== null) ++all;
    if (!too_much.has(name)) {
      since_s = null;
      in_a_row = 0;
      continue;
    }
    since_s ??= time_s;
    ++in_a_row;
    shaped ||= name === "cooling";
    if (time_s - since_s < rule.lasts_s) continue;
    missed += in_a_row;
    max_s = Math.max(max_s, time_s - since_s);
    in_a_row = 0;
  }
  if (missed === 0) return "";
  return `The reference asked for more than the muscle can do, for up to ${significant(max_s)} s at a time and in ${percent(missed, all)} of the time that it was followed: use a slower or smaller one${shaped ? "" : ", or shape_reference"}.`;
}

/** Why it was never armed, or "" when it was. */
export function never_armed_text(store, node, { from_s, to_s }) {
  const states = [...samples(store.table(node, "Status"), ["state", "fault"], from_s, to_s)];
  const name = (value) => store.word("Status", "state", value);
  if (states.length === 0 || states.some(([, state]) => name(state) === "armed" || name(state) === "active")) return "";
  const [, state, fault] = states.at(-1);
  if (name(state) === "fault") return `Never armed: fault ${fault}, ${words(store.word("Status", "fault", fault))}.`;
  const arm = number_of(store, "Acknowledge", "opcode", "arm");
  const attempts = [...samples(store.table(node, "Acknowledge"), ["opcode", "refusal"], from_s, to_s)].filter(([, opcode]) => opcode === arm);
  if (attempts.length === 0) return "Never armed: no arm command.";
  return `Never armed: refused, ${refusal_words(store.word("Acknowledge", "refusal", attempts.at(-1)[2]))}.`;
}

/** {period_s, amplitude_m} of an oscillation with a steady period while the reference was constant, or null. */
export function swing_of(points) {
  const mean_m = points.reduce((sum, [, error_m]) => sum + error_m, 0) / points.length;
  const rms_m = Math.sqrt(points.reduce((sum, [, error_m]) => sum + (error_m - mean_m) ** 2, 0) / points.length);
  const rises_s = [];
  let high = null;
  // Between the two thresholds nothing changes: noise on an oscillation crosses once.
  for (const [time_s, error_m] of points) {
    if (error_m - mean_m > rms_m / 2) {
      if (high === false) rises_s.push(time_s);
      high = true;
    } else if (error_m - mean_m < -rms_m / 2) {
      high = false;
    }
  }
  const periods_s = rises_s.slice(1).map((time_s, i) => time_s - rises_s[i]);
  if (periods_s.length < MIN_PERIODS) return null;
  const period_s = periods_s.reduce((sum, each_s) => sum + each_s, 0) / periods_s.length;
  const spread_s = Math.sqrt(periods_s.reduce((sum, each_s) => sum + (each_s - period_s) ** 2, 0) / periods_s.length);
  return spread_s < MAX_SPREAD_RATIO * period_s ? { period_s, amplitude_m: Math.SQRT2 * rms_m } : null;
}

export function oscillation_text(store, node, { from_s, to_s }) {
  const all = [...samples(store.table(node, "Tracking"), ["error_m", "reference_m"], Math.max(from_s, to_s - WINDOW_S), to_s)];
  // Backwards while the reference has its present value; a gap ends it.
  let first = all.length;
  while (first > 0 && Math.abs(all[first - 1][2] - all.at(-1)[2]) < STILL_M && Number.isFinite(all[first - 1][1])) --first;
  const swing = swing_of(all.slice(first));
  return swing ? `It oscillates by itself: ± ${significant(1e6 * swing.amplitude_m)} µm with a period of ${significant(swing.period_s)} s, while the reference is constant.` : "";
}

/** Reports that the power goes from limit to limit and back with its own period while the reference moves, as the simulator's summary finds it; or "". */
export function cycle_text(store, node, { from_s, to_s }) {
  const newest = [Math.max(from_s, to_s - WINDOW_S), to_s];
  const lasted_s = [];
  let last = null;
  let risen_s = null;
  for (const [time_s, name] of limits(store, node, { from_s: newest[0], to_s }, ["position"])) {
    if (name === null) last = risen_s = null;
    if ((name !== "minimum" && name !== "maximum") || name === last) continue;
    last = name;
    if (name === "minimum") continue;
    if (risen_s !== null) lasted_s.push(time_s - risen_s);
    risen_s = time_s;
  }
  if (lasted_s.length < MIN_CYCLES || oscillation_text(store, node, { from_s, to_s })) return "";
  const middle_s = lasted_s.sort((a, b) => a - b)[Math.floor(lasted_s.length / 2)];
  const alike = lasted_s.filter((each_s) => Math.abs(each_s - middle_s) < SIMILAR_RATIO * middle_s);
  const reference = [...samples(store.table(node, "Tracking"), ["reference_m"], ...newest)].filter(([, value_m]) => Number.isFinite(value_m));
  const max_s = MAX_PERIOD_RATIO * (swing_of(reference)?.period_s ?? Infinity);
  if (2 * alike.length <= lasted_s.length || middle_s > max_s) return "";
  return `The loop oscillates with a period of ${significant(middle_s)} s while the reference moves: its power goes from one limit to the other. Lower its gains, or identify the muscle.`;
}
