// Reduces a table's rows to as many points as a plot has pixels, such that the shortest peak is still visible.
//
// The plot's time is divided into buckets of one pixel; each gives its min and max value, in the order in which they
// came. undefined: no row fell into this half bucket, the line goes on. null: not available, or nothing came for so
// long that the line must break.

import { BLOCK } from "./table.js";

/** Times of the points, two for each bucket. */
export function bucket_times(from_s, to_s, buckets) {
  const times = new Float64Array(2 * buckets);
  const half = (to_s - from_s) / times.length;
  for (let i = 0; i < times.length; ++i) times[i] = from_s + (i + 0.5) * half;
  return times;
}

/**
 * Points of some columns of a table, at bucket_times(from_s, to_s, buckets).
 * gap_s: a longer pause between rows breaks the line.
 */
export function decimate(table, columns, from_s, to_s, buckets, gap_s) {
  const lines = columns.map((column) => new Line(table.columns.indexOf(column), buckets));
  const bucket_s = (to_s - from_s) / buckets;
  const bucket_of = (time_s) => Math.floor((time_s - from_s) / bucket_s);
  const pause_s = Math.max(gap_s, 2 * bucket_s);
  // Blocks suffice when a bucket holds several of them.
  const blocks = table.period_s * BLOCK * 2 < bucket_s;
  let before_s = NaN;
  for (const chunk of table.chunks) {
    if (chunk.last_s < from_s || chunk.first_s > to_s) continue;
    const end = chunk.lower_bound(to_s);
    let row = chunk.lower_bound(from_s);
    if (blocks) row -= row % BLOCK;
    for (let rows; row < end; row += rows) {
      const time_s = chunk.time_s[row];
      rows = blocks && row % BLOCK === 0 && !pauses(chunk, row, pause_s) ? Math.min(BLOCK, chunk.count - row) : 1;
      const bucket = bucket_of(time_s);
      if (bucket < 0 || bucket >= buckets) continue;
      if (time_s - before_s > pause_s) for (const line of lines) line.break_between(bucket_of(before_s), bucket);
      before_s = chunk.time_s[row + rows - 1];
      for (const line of lines) {
        if (line.column < 0) continue;
        if (rows === 1) {
          const value = chunk.values[line.column][row];
          line.add(bucket, value, value);
        } else {
          line.add(bucket, chunk.low[line.column][row / BLOCK], chunk.high[line.column][row / BLOCK]);
        }
      }
    }
  }
  return lines.map((line) => line.finish());
}

/** Whether there is a pause within the block that begins with the row: then its rows are read one by one. */
function pauses(chunk, row, pause_s) {
  return chunk.time_s[Math.min(row + BLOCK, chunk.count) - 1] - chunk.time_s[row] > pause_s;
}

class Line {
  constructor(column, buckets) {
    this.column = column;
    this.points = new Array(2 * buckets); // holes: undefined
    this.bucket = -1;
  }

  add(bucket, low, high) {
    if (bucket !== this.bucket) {
      this.#put();
      this.bucket = bucket;
      this.low = Infinity;
      this.high = -Infinity;
      this.high_last = true;
    }
    // NaN is neither less nor greater than anything.
    if (low < this.low) {
      this.low = low;
      this.high_last = false;
    }
    if (high > this.high) {
      this.high = high;
      this.high_last = true;
    }
  }

  /** Breaks the whole gap: a single null would leave a line with a hole of one pixel. */
  break_between(before, after) {
    this.points.fill(null, 2 * Math.max(0, before + 1), 2 * after);
  }

  #put() {
    if (this.bucket < 0) return;
    const place = 2 * this.bucket;
    if (this.low > this.high) {
      this.points[place] = null;
    } else if (this.low === this.high) {
      this.points[place] = this.low;
    } else {
      this.points[place] = this.high_last ? this.low : this.high;
      this.points[place + 1] = this.high_last ? this.high : this.low;
    }
  }

  finish() {
    this.#put();
    return this.points;
  }
}
