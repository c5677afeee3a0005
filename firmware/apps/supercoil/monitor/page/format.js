// Formats numbers and words for display. A value that is not available becomes a dash.

export const NONE = "–";

/** A fixed number of decimals keeps the digits in place while they change. */
export function fixed(value, decimals) {
  if (value == null || Number.isNaN(value)) return NONE;
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  return value.toFixed(decimals).replace("-", "−");
}

/** Three significant digits, for values of any size. */
export function significant(value) {
  if (value == null || !Number.isFinite(value)) return fixed(value, 0);
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replaceAll("-", "−");
  return fixed(value, Math.max(0, 2 - Math.floor(Math.log10(size))));
}

/** Decimals for a tick's label, so that evenly spaced ticks have evenly spaced labels: 2.5 → 1. */
export function decimals_of(step) {
  const max_decimals = 9;
  let decimals = 0;
  while (decimals < max_decimals && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6) ++decimals;
  return decimals;
}

// Times after 1973 are calendar times; earlier ones count from a start.
const CALENDAR_S = 1e8;

/** A time of the bus. decimals: of the seconds. */
export function bus_time(time_s, decimals = 1) {
  if (time_s == null || Number.isNaN(time_s)) return NONE;
  if (time_s > CALENDAR_S) {
    const date = new Date(time_s * 1e3);
    const clock = [date.getHours(), date.getMinutes(), date.getSeconds()].map((n) => String(n).padStart(2, "0")).join(":");
    return decimals ? `${clock}.${String(Math.floor(date.getMilliseconds() / 10 ** (3 - decimals))).padStart(decimals, "0")}` : clock;
  }
  return `${fixed(time_s, decimals)} s`;
}

/** How long ago something was, or how long it takes. */
export function duration(seconds) {
  if (seconds < 120) return `${Math.floor(seconds)} s`;
  return seconds < 7200 ? `${Math.floor(seconds / 60)} min` : `${Math.floor(seconds / 3600)} h`;
}

/** A value that is held while it cannot be measured is shown with its age. */
export const AGES = { resistance_Ohm: "resistance_age_s" };
const OLD_S = 1;

/** An age that is not available counts as old. */
export const is_old = (age_s) => !(age_s <= OLD_S);

export const measured_ago = (age_s) => (Number.isFinite(age_s) ? `measured ${duration(age_s)} ago` : "not measured for a long time, or never");

/** over_temperature → over temperature */
export const words = (name) => name.replaceAll("_", " ");

export function clock_now() {
  return new Date().toLocaleTimeString([], { hour12: false });
}
