// Every request to supercoil monitor, but for the stream.

const KEY = "supercoil-token";

/** The token that the program printed; "" without. It leaves the address bar, so that no picture of the page has it. */
export const token = take_token();

function take_token() {
  const given = /[#&]token=([0-9a-f]+)/i.exec(location.hash)?.[1];
  if (given) {
    sessionStorage.setItem(KEY, given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return sessionStorage.getItem(KEY) ?? "";
}

async function ask(path, options = {}) {
  const headers = { ...options.headers, ...(token && { "X-Supercoil-Token": token }) };
  const answer = await fetch(path, { cache: "no-store", ...options, headers });
  if (answer.ok) return answer;
  const body = await answer.json().catch(() => ({}));
  throw new Error(body.error ?? `${path}: ${answer.status} ${answer.statusText}`);
}

const post = (path, body) =>
  ask(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });

export const about = async () => (await ask("/api/about")).json();

/** Times of the bus; negative: relative to the newest frame; undefined: all. */
export async function history_of(from_s, to_s) {
  const query = new URLSearchParams();
  if (from_s !== undefined) query.set("from_s", from_s);
  if (to_s !== undefined) query.set("to_s", to_s);
  return (await ask(`/api/history?${query}`)).json();
}

/** Resolves to the refusal's name, "none" when it was obeyed. */
export async function command(node, opcode, value = 0) {
  return (await (await post("/api/command", { node, opcode, value })).json()).refusal;
}

/** This page lives and wants the node to stay hot: {holding, reason}. */
export const alive = async (node) =>
  (await post("/api/alive", { node }).then((answer) => answer.json()));

/** Disarms all nodes, by a port that nothing else can keep busy. Resolves to the nodes. */
export async function stop(port) {
  const address = `${location.protocol}//${location.hostname}:${port}/stop`;
  // text/plain and no header of our own: the browser asks nothing beforehand.
  const options = { method: "POST", headers: { "Content-Type": "text/plain" }, body: token, cache: "no-store" };
  const answer = await fetch(address, options);
  const body = await answer.json().catch(() => ({}));
  if (!answer.ok) throw new Error(body.error ?? `${answer.status} ${answer.statusText}`);
  return body.nodes ?? [];
}

/** A fault's page, as Markdown. */
export const fault_page = async (name) => (await ask(`/api/fault/${encodeURIComponent(name)}`)).text();
