// Set points as functions of time: waveforms to play on a muscle.

import { LENGTH } from "./joint.js";

/** The inputs of a shape, by name: label, unit ("": that of the positions), initial value. */
const OFFSET = { offset: ["offset", "", 8] };
const SWING = { ...OFFSET, amplitude: ["amplitude", "", 2], period: ["period", "s", 10] };
export const SHAPES = {
  sine: SWING,
  steps: SWING,
  chirp: { ...SWING, last_period: ["last period", "s", 2], duration: ["duration", "s", 60] },
  file: {},
};

/** Phase in periods of a swing whose frequency rises linearly from 1/period to 1/last_period. */
const chirped = ({ period, last_period, duration }) => (time_s) =>
  time_s / period + ((1 / last_period - 1 / period) * time_s ** 2) / (2 * duration);

function swing({ offset, amplitude }, phase, shape, { to_m }) {
  return (time_s) => to_m(offset + amplitude * shape(phase(time_s)));
}

const sine = (phase) => Math.sin(2 * Math.PI * phase);
const square = (phase) => (phase % 1 < 0.5 ? 1 : -1);

/** {at: position in m by time in s, end_s}; values: numbers by name, as in SHAPES, positions in the unit of measure. */
export function waveform(shape, values, measure = LENGTH) {
  if (shape === "chirp") return { at: swing(values, chirped(values), sine, measure), end_s: values.duration };
  return { at: swing(values, (time_s) => time_s / values.period, shape === "sine" ? sine : square, measure), end_s: Infinity };
}

/** What is wrong with the values, in words, or "". max_m: the channel's travel. */
export function refuse_values(shape, values, max_m, { unit, of_m, min_m } = LENGTH) {
  for (const [name, [label]] of Object.entries(SHAPES[shape])) {
    const value = values[name];
    if (!Number.isFinite(value)) return `${label}: a number is missing`;
    if (name !== "offset" && name !== "amplitude" && value <= 0) return `${label} must be more than 0`;
  }
  const low = values.offset - Math.abs(values.amplitude);
  const high = values.offset + Math.abs(values.amplitude);
  const max = of_m(max_m), min = of_m(min_m(max_m));
  if (low < min || high > max) {
    return `offset and amplitude reach from ${low.toFixed(2)} to ${high.toFixed(2)} ${unit}; allowed: ${min ? min.toFixed(2) : 0} to ${max.toFixed(2)} ${unit}`;
  }
  return "";
}

const COLUMNS = ["time_s", "position_m"];

/** A file's rows, and the same as a waveform, straight between them. Throws an Error that names line and value. */
export function waveform_of_file(text, max_m, measure = LENGTH) {
  const min_m = measure.min_m(max_m);
  const lines = text.replace(/^\uFEFF/, "").split(/\r?\n/).map((line) => line.split(",").map((cell) => cell.trim()));
  const places = COLUMNS.map((name) => lines[0].indexOf(name));
  if (places.includes(-1)) throw new Error(`line 1: "${lines[0].join(",")}": the first line must name the columns time_s and position_m`);
  const rows = [];
  lines.forEach((cells, i) => {
    if (i === 0 || cells.join("") === "") return;
    const [time_s, position_m] = places.map((place, column) => {
      const value = cells[place] === "" ? NaN : Number(cells[place]);
      if (!Number.isFinite(value)) throw new Error(`line ${i + 1}: ${COLUMNS[column]} is "${cells[place] ?? ""}": a number is needed`);
      return value;
    });
    if (rows.length > 0 && time_s <= rows.at(-1)[0]) throw new Error(`line ${i + 1}: time_s ${time_s} is not later than ${rows.at(-1)[0]} before it`);
    if (position_m < min_m || position_m > max_m) throw new Error(`line ${i + 1}: position_m ${position_m}; allowed: ${Number(min_m.toPrecision(4))} to ${Number(max_m.toPrecision(4))} m`);
    rows.push([time_s, position_m]);
  });
  if (rows.length < 2) throw new Error(`line ${lines.length}: at least two rows are needed`);
  return { at: between(rows), end_s: rows.at(-1)[0] - rows[0][0], rows };
}

function between(rows) {
  let place = 1; // of the row at or after the time; times never decrease
  return (time_s) => {
    const at_s = rows[0][0] + time_s;
    while (place < rows.length - 1 && rows[place][0] < at_s) ++place;
    const [[from_s, from_m], [to_s, to_m]] = [rows[place - 1], rows[place]];
    return from_m + (to_m - from_m) * Math.min(1, Math.max(0, (at_s - from_s) / (to_s - from_s)));
  };
}
