// The quantities in each plot: those of plots.js, until the user chooses others. Remembered in this browser.

import { words } from "./format.js";
import { PLOTS } from "./plots.js";

const KEY = "supercoil-plots";
const COLOURS = ["position", "power", "model", "error", "resistance", "hot", "cold"];
// Messages that can be drawn and are sent periodically.
const MESSAGES = ["Measurement", "Tracking", "Power", "Heater", "Temperature", "Timing"];

const id_of = ({ message, column }) => `${message}.${column}`;

/** All quantities with a plot's unit: its own lines first. [{message, column, name, colour, …}] */
export function quantities_of(spec, protocol) {
  const [first] = spec.lines;
  const unit = protocol[first.message]?.[first.column]?.unit;
  const own = new Set(spec.lines.map(id_of));
  const others = [];
  for (const message of unit === undefined ? [] : MESSAGES)
    for (const [column, signal] of Object.entries(protocol[message] ?? {}))
      if (signal.unit === unit && !signal.values && !own.has(`${message}.${column}`)) others.push({ message, column, name: named(message, column, signal.unit) });
  return [...spec.lines, ...others.map((line, i) => ({ ...line, colour: COLOURS[(i + spec.lines.length) % COLOURS.length] }))];
}

/** position_m → position; the name of a line in plots.js takes precedence over its signal's. */
function named(message, column, unit) {
  const known = PLOTS.flatMap(({ lines }) => lines).find((line) => line.message === message && line.column === column);
  return known?.name ?? words(column.replace(new RegExp(`_${unit}$`), ""));
}

const remembered = () => {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? {};
  } catch {
    return {}; // other data, or access denied
  }
};

/** The chosen plots; omits plots without lines. */
export function chosen_plots(protocol) {
  const chosen = remembered();
  return PLOTS.map((spec) => {
    const ids = chosen[spec.title];
    if (!Array.isArray(ids)) return spec;
    const lines = quantities_of(spec, protocol).filter((line) => ids.includes(id_of(line)));
    // The band lies between two particular lines.
    const band = spec.band?.every((place) => ids.includes(id_of(spec.lines[place]))) ? spec.band : undefined;
    return { ...spec, lines, band };
  }).filter(({ lines }) => lines.length > 0);
}

export function choose(title, lines) {
  localStorage.setItem(KEY, JSON.stringify({ ...remembered(), [title]: lines.map(id_of) }));
}

export const choose_usual = () => localStorage.removeItem(KEY);
