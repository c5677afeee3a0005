// The muscle as the board uses it: configured, or what identify and calibrate found. The board sends it on request.

import { element, scrolling, show } from "./dom.js";
import { NONE, bus_time, significant } from "./format.js";
import { muscle_of } from "./server.js";

// Muscle.quantity → its name and unit; and the coefficients of the model, which follow from these.
const QUANTITIES = {
  thermal_mass_J_per_K: ["thermal mass", "J/K"], heat_transfer_W_per_K: ["heat transfer", "W/K"], stiffness_N_per_m: ["stiffness", "N/m"],
  damping_Ns_per_m: ["damping", "N·s/m"], moving_mass_kg: ["moving mass", "kg"], force_per_kelvin_N_per_K: ["force per kelvin", "N/K"],
  cold_resistance_Ohm: ["cold resistance", "Ω"], position_offset_m: ["sensor at zero", "m"], position_scale: ["position scale", ""],
  response_ratio: ["response to small motions", ""], unexplained_ratio: ["unexplained power fraction", ""],
};
const DERIVED = {
  time_constant: ["time constant", "s", ({ c, h }) => c / h],
  gain: ["gain", "mm/W", ({ h, k, force }) => (1e3 * force) / (h * k)],
  theta1: ["θ1", "m", ({ c, force }) => c / force],
  theta2: ["θ2", "W·s²/m", ({ c, h, d, m, force }) => (m * h + d * c) / force],
  theta3: ["θ3", "W·s/m", ({ c, h, k, d, force }) => (c * k + d * h) / force],
  theta4: ["θ4", "W/m", ({ h, k, force }) => (h * k) / force],
};

// Identifies the muscle that an answer described; in single precision, as text.
const COMPARED = ["theta2_deviation_ratio", "theta3_deviation_ratio", "theta4_deviation_ratio", "stiffness_N_per_m"];
const SAME_RATIO = 1e-6;

const is_same_muscle = (answer, received) => COMPARED.every((name) => Math.abs(received[name] - answer[name]) <= SAME_RATIO * Math.abs(answer[name]));

const percent = (ratio) => (ratio >= 0 ? `± ${significant(100 * ratio)} %` : NONE);

/** "2026-11-28 07:15 UTC" of seconds since 1970. */
const minute = (since_1970_s) => `${new Date(1e3 * since_1970_s).toISOString().slice(0, 16).replace("T", " ")} UTC`;

/** When the muscle in use was identified: the time, "before" if earlier than the history reaches, null: never. */
function identified_since(store, node, now_s) {
  let later = null;
  const is = (row, signal, name) => row && store.word("Status", signal, row[signal]) === name;
  for (const row of store.table(node, "Status")?.back_from(now_s) ?? []) {
    if (is(later, "result", "found") && is(row, "mode", "identify") && !is(row, "result", "found")) return later.time_s;
    later = row;
  }
  return null;
}

export class Identified {
  constructor(node, store, has_board) {
    Object.assign(this, { node, store, has_board, rows: new Map(), problem: "", answer: {} });
    const body = element("tbody");
    for (const [name, [title, unit]] of Object.entries({ ...DERIVED, ...QUANTITIES })) {
      const cells = ["value", "deviation", "value"].map((kind) => element("td", { class: kind }, NONE));
      body.append(element("tr", {}, element("th", { scope: "row" }, title), cells[0], element("td", { class: "unit" }, unit), ...cells.slice(1)));
      this.rows.set(name, cells);
    }
    this.since = element("p", { class: "hint", role: "status" });
    this.again = element("button", { type: "button", hidden: !has_board, onclick: () => this.#request() }, "ask again");
    this.element = element("section", { class: "card full-only", "aria-label": `muscle in use, node ${node}` }, element("h2", {}, "Muscle in use"), this.since,
      scrolling(`table of what is in use, node ${node}`, element("table", { class: "parameters" }, element("thead", {}, element("tr", {},
        ...["parameter", "in use", "unit", "deviation", "board.toml"].map((title) => element("th", { scope: "col" }, title)))), body)), this.again);
  }

  async #request() {
    this.problem = "";
    await muscle_of(this.node).then((answer) => (this.answer = answer), ({ message }) => (this.problem = `not known: ${message}`));
    this.key = undefined;
  }

  /** Asks once, and whenever identify or calibrate has ended. */
  update(now_s) {
    const result = this.store.at(this.node, "Status", now_s)?.result;
    if (this.has_board && result !== undefined && result !== this.result) this.#request();
    this.result = result;
    const received = {};
    for (const [number, { value }] of this.store.round(this.node, "Muscle", "quantity", now_s)) received[this.store.word("Muscle", "quantity", number)] = value;
    // The server derives deviations that boards do not send.
    const known = { ...(is_same_muscle(this.answer, received) ? this.answer : {}), ...received };
    for (const by of ["", "configured_"]) {
      const physical = { c: known[`${by}thermal_mass_J_per_K`], h: known[`${by}heat_transfer_W_per_K`], k: known[`${by}stiffness_N_per_m`],
        d: known[`${by}damping_Ns_per_m`], m: known[`${by}moving_mass_kg`], force: known[`${by}force_per_kelvin_N_per_K`] };
      for (const [name, [, , of]] of Object.entries(DERIVED)) known[`${by}${name}`] = of(physical);
    }
    for (const [name, [value, deviation, configured]] of this.rows) {
      show(value, significant(known[name]));
      show(deviation, percent(known[`${name}_deviation_ratio`]));
      show(configured, significant(known[`configured_${name}`]));
    }
    // The search goes far back: only do it when something has changed.
    const key = [result, known.stiffness_N_per_m, known.theta4_deviation_ratio, known.identified_s, this.problem, this.has_board || Math.floor(now_s)].join();
    if (key !== this.key) show(this.since, this.problem || this.#since(known, now_s));
    this.key = key;
  }

  #since(known, now_s) {
    if (known.stiffness_N_per_m === undefined) return this.has_board ? "asking the board …" : "No program asked the board for it in this log.";
    const since_s = identified_since(this.store, this.node, now_s);
    if (since_s !== null) return `Identified; in use since ${bus_time(since_s)}.`;
    if (known.identified_s > 0) return `Identified ${minute(known.identified_s)}, before the board started.`;
    if (known.theta4_deviation_ratio >= 0) return "Identified since the board started, before this page's data begins.";
    return "Not identified since the board started: configured, or stored from before.";
  }
}
