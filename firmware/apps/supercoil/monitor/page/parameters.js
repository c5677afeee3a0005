// The estimated parameters of the muscle, whether they are trusted, and standard deviations if the estimator has any.

import { element, scrolling, show } from "./dom.js";
import { NONE, fixed, significant } from "./format.js";

const SIGNALS = {
  thermal_mass: ["thermal_mass_J_per_K", "thermal mass"],
  heat_transfer: ["heat_transfer_W_per_K", "heat transfer"],
  stiffness: ["stiffness_N_per_m", "stiffness"],
  damping: ["damping_Ns_per_m", "damping"],
  theta1: ["theta1", "θ1", "theta1_deviation"],
  theta2: ["theta2", "θ2", "theta2_deviation"],
  theta3: ["theta3", "θ3", "theta3_deviation"],
  theta4: ["theta4", "θ4", "theta4_deviation"],
  bias: ["bias_W", "bias", "bias_deviation_W"],
};
const KINDS = ["value", "deviation", "bound", "trusted"];
const UNITS = { "W s2/m": "W·s²/m", "W s/m": "W·s/m", "Ns/m": "N·s/m" };

export class Parameters {
  constructor(node, store) {
    Object.assign(this, { node, store, rows: new Map() });
    const body = element("tbody");
    for (const [name, [signal, title, deviation]] of Object.entries(SIGNALS)) {
      const cells = KINDS.map((kind) => element("td", { class: kind }, NONE));
      const unit = store.protocol.Estimate?.[signal]?.unit ?? "";
      body.append(element("tr", {}, element("th", { scope: "row" }, title), cells[0], element("td", { class: "unit" }, UNITS[unit] ?? unit), ...cells.slice(1)));
      this.rows.set(name, { signal, deviation, cells });
    }
    this.element = element("section", { class: "card full-only", "aria-label": `parameters of node ${node}` },
      element("h2", {}, "Parameters"),
      scrolling(`table of the parameters, node ${node}`, element("table", { class: "parameters" }, element("thead", {}, element("tr", {},
        ...["parameter", "value", "unit", "deviation", "bound", "trust"].map((title) => element("th", { scope: "col" }, title)))), body)),
      element("p", { class: "hint" }, "Position and power determine the time constant, which is thermal mass over heat transfer, but neither of these alone: what is learned here does not narrow the temperature."));
  }

  update(now_s) {
    const newest = new Map();
    for (const [number, row] of this.store.round(this.node, "Estimate", "parameter", now_s))
      newest.set(this.store.word("Estimate", "parameter", number), row);
    for (const [name, { signal, deviation, cells }] of this.rows) {
      const row = newest.get(name);
      const deviates = newest.get(`${name}_deviation`)?.[deviation];
      const texts = [significant(row?.[signal]), deviates >= 0 ? `± ${significant(deviates)}` : NONE,
        name === "bias" ? NONE : bound(row), !row ? NONE : row.trusted ? "✓ trusted" : "not yet"];
      cells.forEach((cell, i) => show(cell, texts[i]));
      cells.at(-1).classList.toggle("yes", row?.trusted === 1);
    }
  }
}

/** The error bound of all of θ. */
function bound(row) {
  if (!(row?.error_bound >= 0)) return NONE;
  return row.error_bound >= 6.5 ? "> 650 %" : `± ${fixed(100 * row.error_bound, 0)} %`;
}
