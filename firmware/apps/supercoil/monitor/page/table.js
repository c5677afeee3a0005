// The received rows of one message of one node: columns of numbers, ordered by time, an hour of them.
//
// Rows are stored in chunks, so that memory grows as data comes, a full hour moves on without copying, and older rows can be
// put in front. For every BLOCK rows the min and max value are kept: a plot of an hour reads these instead of a third of a
// million rows.

export const BLOCK = 64;
const CHUNK_ROWS = 64 * BLOCK;
const PERIOD_ROWS = 10;

class Chunk {
  constructor(columns, rows, Numbers) {
    this.count = 0;
    this.time_s = new Float64Array(rows);
    this.values = columns.map(() => new Numbers(rows));
    const blocks = Math.ceil(rows / BLOCK);
    this.low = columns.map(() => new Numbers(blocks).fill(NaN));
    this.high = columns.map(() => new Numbers(blocks).fill(NaN));
  }

  get full() {
    return this.count === this.time_s.length;
  }

  get first_s() {
    return this.time_s[0];
  }

  get last_s() {
    return this.time_s[this.count - 1];
  }

  /** Appends the batch's rows from..to, as many as have room; returns the row where it stopped. */
  append(batch, columns, from, to) {
    const end = Math.min(to, from + this.time_s.length - this.count);
    const offset = this.count - from;
    for (let row = from; row < end; ++row) this.time_s[row + offset] = batch.time_s[row];
    columns.forEach((column, c) => {
      const source = batch[column];
      const values = this.values[c];
      for (let row = from; row < end; ++row) {
        const value = source?.[row] ?? NaN;
        values[row + offset] = value;
        const block = Math.floor((row + offset) / BLOCK);
        if (!(value >= this.low[c][block])) this.low[c][block] = lesser(value, this.low[c][block]);
        if (!(value <= this.high[c][block])) this.high[c][block] = greater(value, this.high[c][block]);
      }
    });
    this.count += end - from;
    return end;
  }

  /** The first row at or after the time. */
  lower_bound(time_s) {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time_s[middle] < time_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

// NaN is "not available" and never a min or a max.
const lesser = (value, min) => (Number.isNaN(value) || min < value ? min : value);
const greater = (value, max) => (Number.isNaN(value) || max > value ? max : value);

export class Table {
  /**
   * keep_s: rows older than this before the newest are dropped, chunk by chunk. Numbers: the typed array for the
   * columns.
   */
  constructor(columns, keep_s, Numbers = Float32Array) {
    this.columns = columns;
    this.keep_s = keep_s;
    this.Numbers = Numbers;
    this.chunks = [];
  }

  get empty() {
    return this.chunks.length === 0;
  }

  get first_s() {
    return this.empty ? NaN : this.chunks[0].first_s;
  }

  get last_s() {
    return this.empty ? NaN : this.chunks.at(-1).last_s;
  }

  /** Usual time between rows, from the newest rows: a pause among them does not count. */
  get period_s() {
    if (this.empty) return 0;
    const newest = [...this.chunks.at(-1).time_s.subarray(0, this.chunks.at(-1).count).slice(-PERIOD_ROWS)];
    const periods_s = newest.slice(1).map((time_s, i) => time_s - newest[i]).sort((a, b) => a - b);
    return periods_s[Math.floor((periods_s.length - 1) / 2)] ?? 0;
  }

  /** Appends the rows that are newer than all present ones; the others are known already. */
  append(batch) {
    const rows = batch.time_s.length;
    let row = 0;
    if (!this.empty) while (row < rows && batch.time_s[row] <= this.last_s) ++row;
    while (row < rows) {
      if (this.empty || this.chunks.at(-1).full) this.chunks.push(new Chunk(this.columns, CHUNK_ROWS, this.Numbers));
      row = this.chunks.at(-1).append(batch, this.columns, row, rows);
    }
    while (this.chunks.length > 1 && this.chunks[0].last_s < this.last_s - this.keep_s) this.chunks.shift();
  }

  /** Puts the rows that are older than all present ones in front. */
  prepend(batch) {
    let rows = batch.time_s.length;
    if (!this.empty) while (rows > 0 && batch.time_s[rows - 1] >= this.first_s) --rows;
    if (rows === 0) return;
    const chunk = new Chunk(this.columns, rows, this.Numbers);
    chunk.append(batch, this.columns, 0, rows);
    this.chunks.unshift(chunk);
  }

  /** The newest row at or before the time: a function from column to value, or null. */
  at(time_s) {
    for (const row of this.back_from(time_s)) return row;
    return null;
  }

  /** Rows from the newest at or before the time backwards. */
  *back_from(time_s) {
    for (let i = this.chunks.length - 1; i >= 0; --i) {
      const chunk = this.chunks[i];
      if (chunk.first_s > time_s) continue;
      let row = chunk.lower_bound(time_s);
      if (row === chunk.count || chunk.time_s[row] > time_s) --row;
      for (; row >= 0; --row) yield this.#row(chunk, row);
    }
  }

  #row(chunk, row) {
    const values = { time_s: chunk.time_s[row] };
    this.columns.forEach((column, c) => (values[column] = chunk.values[c][row]));
    return values;
  }

  /** Rows from..to, forwards. */
  *rows(from_s, to_s) {
    for (const chunk of this.chunks) {
      if (chunk.last_s < from_s || chunk.first_s > to_s) continue;
      for (let row = chunk.lower_bound(from_s); row < chunk.count && chunk.time_s[row] <= to_s; ++row)
        yield this.#row(chunk, row);
    }
  }
}
