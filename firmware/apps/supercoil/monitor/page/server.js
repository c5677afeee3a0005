// Every request to supercoil monitor, except the stream.

const KEY = "supercoil-token";

/** The token that the program printed; "" without. It is removed from the address bar, so that no screenshot of the page shows it. */
export const token = take_token();

function take_token() {
  const given = /[#&]token=([0-9a-f]+)/i.exec(location.hash)?.[1];
  if (given) {
    sessionStorage.setItem(KEY, given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return sessionStorage.getItem(KEY) ?? "";
}

// For STOP; after this time the fallback is tried.
const STOP_WITHIN_MS = 500;

async function request(path, options = {}) {
  const headers = { ...options.headers, ...(token && { "X-Supercoil-Token": token }) };
  const answer = await fetch(path, { cache: "no-store", ...options, headers });
  if (answer.ok) return answer;
  const body = await answer.json().catch(() => ({}));
  throw new Error(body.error ?? `${path}: ${answer.status} ${answer.statusText}`);
}

const post = (path, body, options) =>
  request(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body), ...options });

/** Gives up after a time limit, even while the answer is being read. act: gets the options for fetch. */
async function within(limit_ms, act) {
  try {
    return await act({ signal: AbortSignal.timeout(limit_ms) });
  } catch (problem) {
    throw problem.name === "TimeoutError" ? new Error(`no answer within ${limit_ms / 1e3} s`) : problem;
  }
}

export const about = async () => (await request("/api/about")).json();

/** Times of the bus; negative: relative to the newest frame; undefined: all. */
export async function history_of(from_s, to_s) {
  const query = new URLSearchParams();
  if (from_s !== undefined) query.set("from_s", from_s);
  if (to_s !== undefined) query.set("to_s", to_s);
  return (await request(`/api/history?${query}`)).json();
}

/** Resolves to the refusal's name; "none": it was obeyed. */
export async function command(node, opcode, value = 0, options = {}) {
  return (await (await post("/api/command", { node, opcode, value }, options)).json()).refusal;
}

/** Sends knots [{after_s, position_m, velocity_m_per_s}] of a trajectory, and its start; neither: only asks. Resolves to {refusal, taken, playback, room, buffered_s}. */
export const play = async (node, knots, start) => (await post("/api/trajectory", { node, knots, start })).json();

/** All values of a node: {controllers: [{controller, kind: {in_use, …}, …}], estimators: [{estimator, …}], choices: {controllers: {kind: […], …}, estimators}}. */
export const tuning_of = async (node) => (await request(`/api/tuning/${node}`)).json();

/** The kinds in use of a node: {controllers: ["mrac", …], estimators: […]}. */
export const kinds_of = async (node) => (await request(`/api/kinds/${node}`)).json();

/** Makes a node report the muscle that it uses: the stream has it too, as Muscle, except for the deviations that the server derives. */
export const muscle_of = async (node) => (await request(`/api/muscle/${node}`)).json();

/** Changes values (texts by name), starting from those of a set. Resolves to the refusal's name. */
export const tune = async (node, place, from, values) =>
  (await (await post("/api/tuning", { node, place, from, values })).json()).refusal;

/** The state of setup: SetupSession's. */
export const setup_state = async () => (await request("/api/setup")).json();

/** order: {do: "begin", step}, {do: "answer", text}, {do: "end"} or {do: "undo"}. Resolves to the state after it. */
export const request_setup = async (order) => (await post("/api/setup", order)).json();

/** STOP's fallback: an ordinary command with a deadline. */
export const disarm_within = (limit_ms, node) => within(limit_ms, (options) => command(node, "disarm", 0, options));

/** Reports that this page is alive and wants the node to stay hot: {holding, reason}. */
export const alive = async (node) =>
  (await post("/api/alive", { node }).then((answer) => answer.json()));

/** Disarms all nodes, through a port that nothing else can keep busy. Resolves to the nodes. */
export function stop(port) {
  const address = `${location.protocol}//${location.hostname}:${port}/stop`;
  return within(STOP_WITHIN_MS, async (options) => {
    // text/plain and no header of our own: the browser sends no preflight request.
    const answer = await fetch(address, { method: "POST", headers: { "Content-Type": "text/plain" }, body: token, cache: "no-store", ...options });
    const body = await answer.json().catch((problem) => ({ error: problem.message }));
    if (!answer.ok) throw new Error(body.error ?? `${answer.status} ${answer.statusText}`);
    return body.nodes ?? [];
  });
}

/** A fault's page, as Markdown. */
export const fault_page = async (name) => (await request(`/api/fault/${encodeURIComponent(name)}`)).text();
