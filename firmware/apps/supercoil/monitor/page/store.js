// All received data, by node and message.

import { Table } from "./table.js";

const HOUR_S = 3600;
// The precision of a Float32Array.
const SINGLE_DIGITS = 8;
// A restarted source begins at an earlier time; frames of one source are never this much out of order.
const RESTART_S = 1;

export class Store extends EventTarget {
  /** protocol: messages with their signals, as in /api/about. A log is kept whole, a live bus for an hour. */
  constructor(protocol, is_log) {
    super();
    this.protocol = protocol;
    this.keep_s = is_log ? Infinity : HOUR_S;
    this.#clear();
  }

  #clear() {
    this.nodes = new Map(); // node number → message's name → Table
    this.bus = new Table(["load", "frames_per_s", "error_frames", "dropped", "foreign_per_s"], this.keep_s);
    this.oldest_s = NaN;
    this.newest_s = NaN;
    this.received_ms = NaN;
  }

  /** Time since the last data, on this page's own clock: 0 in a log. */
  get silent_s() {
    return this.keep_s === Infinity ? 0 : (performance.now() - this.received_ms) / 1e3;
  }

  get empty() {
    return Number.isNaN(this.newest_s);
  }

  append(batch) {
    if (batch.newest_s == null) return;
    if (batch.newest_s < this.newest_s - RESTART_S) {
      this.#clear();
      this.dispatchEvent(new Event("restart"));
    }
    this.#each(batch, (table, rows) => table.append(rows));
    if (batch.bus) {
      const row = Object.fromEntries(Object.entries(batch.bus).map(([name, value]) => [name, [value]]));
      this.bus.append({ time_s: [batch.newest_s], ...row });
    }
    this.newest_s = batch.newest_s;
    this.received_ms = performance.now();
    this.dispatchEvent(new CustomEvent("batch", { detail: batch }));
  }

  /** Adds older rows; returns whether there were any. */
  prepend(batch) {
    const before_s = this.oldest_s;
    this.#each(batch, (table, rows) => table.prepend(rows));
    return this.oldest_s < before_s;
  }

  #each(batch, put) {
    for (const [number, messages] of Object.entries(batch.nodes ?? {})) {
      for (const [message, rows] of Object.entries(messages)) {
        if (!rows.time_s?.length) continue;
        put(this.#table(Number(number), message, rows), rows);
        if (!(this.oldest_s <= rows.time_s[0])) this.oldest_s = rows.time_s[0];
      }
    }
  }

  #table(number, message, rows) {
    if (!this.nodes.has(number)) {
      this.nodes.set(number, new Map());
      this.dispatchEvent(new CustomEvent("node", { detail: number }));
    }
    const messages = this.nodes.get(number);
    if (!messages.has(message)) {
      const signals = Object.keys(this.protocol[message] ?? rows).filter((name) => name !== "time_s");
      const precise = signals.some((name) => this.protocol[message]?.[name].digits > SINGLE_DIGITS);
      messages.set(message, new Table(signals, this.keep_s, precise ? Float64Array : Float32Array));
    }
    return messages.get(message);
  }

  /** The table of a node's message, or null if none came. */
  table(node, message) {
    return message === "bus" ? this.bus : (this.nodes.get(node)?.get(message) ?? null);
  }

  /** The newest row of a node's message at or before the time, or null. */
  at(node, message, time_s) {
    return this.table(node, message)?.at(time_s) ?? null;
  }

  /** The newest row for each value of a signal that selects the content of the frame. */
  round(node, message, signal, time_s) {
    const names = this.protocol[message]?.[signal]?.values ?? {};
    const wanted = Object.keys(names).length;
    const newest = new Map();
    let looked = 0;
    for (const row of this.table(node, message)?.back_from(time_s) ?? []) {
      if (!newest.has(row[signal])) newest.set(row[signal], row);
      if (newest.size === wanted || ++looked === 2 * wanted) break;
    }
    return newest;
  }

  /** The name of an enumeration's value. */
  word(message, signal, value) {
    return this.protocol[message]?.[signal]?.values?.[value] ?? String(value);
  }
}
