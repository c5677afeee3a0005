// The look and the range of a plot's axes.

import { colour } from "./dom.js";
import { bus_time, decimals_of, fixed } from "./format.js";

const TIME_STEPS_S = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600];

/** Axes of time and values, for uPlot. */
export function axes() {
  const axis = { stroke: () => colour("ink-2"), grid: { stroke: () => colour("grid"), width: 1 }, font: "11px system-ui", ticks: { show: false } };
  return [
    { ...axis, size: 27, gap: 8, incrs: TIME_STEPS_S, space: 70, values: (_, times, place, space, step) => times.map((time) => bus_time(time, decimals_of(step))) },
    { ...axis, size: 46, gap: 4, space: 28, values: (_, values, place, space, step) => values.map((value) => fixed(value, decimals_of(step))) },
  ];
}

/** Ends at round numbers: the axis stands still while the values fluctuate. limit: null if there is none. */
export function round_span(low, high, { from_zero, show_limit, min_span }, limit) {
  if (from_zero) low = Math.min(0, low);
  if (limit !== null && (show_limit || high > 0.8 * limit)) high = Math.max(high, limit * 1.04);
  const missing = min_span - (high - low);
  if (missing > 0) {
    high += from_zero ? missing : missing / 2;
    low -= from_zero ? 0 : missing / 2;
  }
  const step = 10 ** Math.floor(Math.log10(high - low)) / 2;
  // Noise around a round number does not get another step.
  return [Math.floor(low / step + 0.05) * step, Math.ceil((high + 0.03 * (high - low)) / step) * step];
}
