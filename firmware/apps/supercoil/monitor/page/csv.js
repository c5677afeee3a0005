// The received data as CSV: a row for each frame, its signals in columns named MESSAGE.SIGNAL, times of the bus.
// SI units, as the signals' names say; names for enumerations; empty: not available, or another message.

const ROWS_PER_PART = 20000;

function header(store, messages) {
  const columns = [];
  for (const message of messages)
    for (const signal of store.protocol[message] ? Object.keys(store.protocol[message]) : [])
      if (signal !== "time_s") columns.push({ message, signal, ...store.protocol[message][signal] });
  return columns;
}

function text(value, { values, digits }) {
  if (Number.isNaN(value)) return "";
  return values?.[value] ?? String(Number(value.toPrecision(digits)));
}

/** All frames of the nodes between two times, merged in order. Yields text, piece by piece. */
function* lines(store, nodes, from_s, to_s) {
  const streams = [];
  for (const node of nodes)
    for (const [message, table] of store.nodes.get(node) ?? [])
      streams.push({ node, message, rows: table.rows(from_s, to_s), row: null });
  const columns = header(store, new Set(streams.map((stream) => stream.message)));
  yield `time_s,node,${columns.map(({ message, signal }) => `${message}.${signal}`).join(",")}\n`;
  const advance = (stream) => (stream.row = stream.rows.next().value);
  let left = streams.filter(advance);
  while (left.length > 0) {
    const next = left.reduce((first, other) => (other.row.time_s < first.row.time_s ? other : first));
    const cells = columns.map((column) => (column.message === next.message ? text(next.row[column.signal], column) : ""));
    yield `${next.row.time_s.toFixed(6)},${next.node},${cells.join(",")}\n`;
    if (!advance(next)) left = left.filter((stream) => stream !== next);
  }
}

/** Resolves to a Blob; lets the page respond in between. */
export async function csv(store, nodes, { from_s, to_s }) {
  const parts = [];
  let part = [];
  for (const line of lines(store, nodes, from_s, to_s)) {
    part.push(line);
    if (part.length < ROWS_PER_PART) continue;
    parts.push(new Blob([part.join("")]));
    part = [];
    await new Promise((resume) => setTimeout(resume));
  }
  return new Blob([...parts, part.join("")], { type: "text/csv" });
}

export function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
