// From a table's rows to as many points as a plot has pixels, so that the shortest peak is still seen.
//
// The plot's time is cut into buckets of a pixel; each gives the least and the greatest value in it, in the order in
// which they came. undefined: no row fell into this half bucket, the line goes on. null: not available, or nothing came
// for so long that the line has to break.

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
  let before_s = NaN;
  for (const chunk of table.chunks) {
    if (chunk.last_s < from_s || chunk.first_s > to_s) continue;
    const first = chunk.lower_bound(from_s);
    const end = chunk.lower_bound(to_s);
    const row_s = (chunk.last_s - chunk.first_s) / chunk.count;
    // Blocks do when a bucket holds several of them.
    const step = row_s * BLOCK * 2 < bucket_s ? BLOCK : 1;
    for (let row = first - (first % step); row < end; row += step) {
      const time_s = chunk.time_s[row];
      const bucket = Math.floor((time_s - from_s) / bucket_s);
      if (bucket < 0 || bucket >= buckets) continue;
      if (time_s - before_s > Math.max(gap_s, 2 * bucket_s)) {
        const middle = Math.floor(((time_s + before_s) / 2 - from_s) / bucket_s);
        for (const line of lines) line.break_at(middle);
      }
      before_s = chunk.time_s[Math.min(row + step, chunk.count) - 1];
      for (const line of lines) {
        if (line.column < 0) continue;
        if (step === 1) {
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

class Line {
  constructor(column, buckets) {
    this.column = column;
    this.buckets = buckets;
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
    // NaN is neither less nor greater.
    if (low < this.low) {
      this.low = low;
      this.high_last = false;
    }
    if (high > this.high) {
      this.high = high;
      this.high_last = true;
    }
  }

  break_at(bucket) {
    if (bucket >= 0 && bucket < this.buckets) this.points[2 * bucket] = null;
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
