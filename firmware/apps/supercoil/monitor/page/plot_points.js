// The points of a plot's lines, from a store's tables.

import { decimate } from "./decimate.js";

// Messages come ten times a second or more often; a gap this long means that something was lost.
const GAP_S = 1;

/** A pause between rows that is longer than their rhythm. */
const gap_s = (table) => Math.max(GAP_S, 4 * table.period_s);

function columns_of(table, columns, { from_s, to_s }, buckets) {
  if (!table || table.empty) return columns.map(() => new Array(2 * buckets).fill(null));
  return decimate(table, columns, from_s, to_s, buckets, gap_s(table));
}

/** For each line its values times factor, at bucket_times() of the range. table_of: a message's table, or null. */
export function points_of(lines, factor, table_of, range, buckets) {
  const columns = new Map();
  for (const { message, column } of lines) columns.set(message, [...(columns.get(message) ?? []), column]);
  const points = new Map();
  for (const [message, names] of columns)
    columns_of(table_of(message), names, range, buckets).forEach((line, i) => points.set(`${message}.${names[i]}`, line));
  return lines.map(({ message, column }) => points.get(`${message}.${column}`).map((value) => value && value * factor));
}
