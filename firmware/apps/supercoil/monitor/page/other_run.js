// Another run, drawn pale under the current one: one that was shown earlier, or a CSV that was exported earlier.

import { Store } from "./store.js";

/** A batch for each node from a CSV of csv.js; drops words, which no plot shows. Throws what is wrong with it. */
export function batch_of_csv(text) {
  const [head, ...lines] = text.replace(/^\uFEFF/, "").trimEnd().split(/\r?\n/);
  const columns = head.split(",");
  if (columns[0] !== "time_s" || columns[1] !== "node") throw new Error('line 1: the columns must begin with time_s,node, as in a CSV that was exported here');
  const nodes = {};
  let newest_s = -Infinity;
  lines.forEach((line, i) => {
    const cells = line.split(",");
    const time_s = Number(cells[0]);
    if (cells.length !== columns.length || cells[0] === "" || !(time_s >= newest_s)) throw new Error(`line ${i + 2}: ${columns.length} cells are needed, and a time_s not before that of the line above; the line is "${line.slice(0, 40)}"`);
    newest_s = time_s;
    const messages = (nodes[cells[1]] ??= {});
    const touched = new Set();
    for (let c = 2; c < cells.length; ++c) {
      if (cells[c] === "") continue;
      const [message, signal] = columns[c].split(".");
      const rows = (messages[message] ??= { time_s: [] });
      if (!touched.has(message)) rows.time_s.push(time_s);
      touched.add(message);
      // Earlier rows without a value stay empty.
      (rows[signal] ??= [])[rows.time_s.length - 1] = Number(cells[c]);
    }
  });
  if (lines.length === 0) throw new Error("line 1: there are no rows below it");
  return { newest_s, nodes };
}

/** The rows of some nodes between two times, as a batch. */
export function batch_of_store(store, numbers, { from_s, to_s }) {
  const nodes = {};
  for (const number of numbers) {
    nodes[number] = {};
    for (const [message, table] of store.nodes.get(number) ?? []) {
      const rows = { time_s: [], ...Object.fromEntries(table.columns.map((column) => [column, []])) };
      for (const row of table.rows(from_s, to_s)) for (const column in rows) rows[column].push(row[column]);
      nodes[number][message] = rows;
    }
  }
  return { newest_s: to_s, nodes };
}

export class OtherRun extends EventTarget {
  constructor(protocol) {
    super();
    Object.assign(this, { protocol, store: null, later_s: 0, name: "" });
  }

  /** Takes a batch; at first it lies at its own time. */
  take(batch, name) {
    this.store = new Store(this.protocol, true);
    this.store.append(batch);
    this.name = name;
    this.#shift_by(0);
  }

  drop() {
    this.store = null;
    this.#shift_by(0);
  }

  /** Moves its beginning to another time. */
  begin_at(time_s) {
    if (this.store) this.#shift_by(time_s - this.store.oldest_s);
  }

  #shift_by(later_s) {
    this.later_s = later_s;
    this.dispatchEvent(new Event("change"));
  }

  /** For a log of a single node, any node's rows will do. */
  table(node, message) {
    if (!this.store) return null;
    const number = this.store.nodes.has(node) ? node : [...this.store.nodes.keys()][0];
    return this.store.table(number, message);
  }
}
