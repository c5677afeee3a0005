// What the board has learned of the muscle, with its trust.

import { element, show } from "./dom.js";
import { NONE, fixed, significant } from "./format.js";

const SIGNALS = {
  thermal_mass: ["thermal_mass_J_per_K", "thermal mass"],
  heat_transfer: ["heat_transfer_W_per_K", "heat transfer"],
  stiffness: ["stiffness_N_per_m", "stiffness"],
  damping: ["damping_Ns_per_m", "damping"],
  theta1: ["theta1", "θ1"],
  theta2: ["theta2", "θ2"],
  theta3: ["theta3", "θ3"],
  theta4: ["theta4", "θ4"],
};
const UNITS = { "W s2/m": "W·s²/m", "W s/m": "W·s/m", "Ns/m": "N·s/m" };

export class Parameters {
  constructor(node, store) {
    Object.assign(this, { node, store, rows: new Map() });
    const body = element("tbody");
    for (const [name, [signal, title]] of Object.entries(SIGNALS)) {
      const cells = ["value", "bound", "trusted"].map((kind) => element("td", { class: kind }, NONE));
      const unit = store.protocol.Estimate?.[signal]?.unit ?? "";
      body.append(element("tr", {}, element("th", { scope: "row" }, title), cells[0], element("td", { class: "unit" }, UNITS[unit] ?? unit), cells[1], cells[2]));
      this.rows.set(name, { signal, cells });
    }
    this.element = element("section", { class: "card full-only", "aria-label": `parameters of node ${node}` },
      element("h2", {}, "Parameters"),
      element("table", { class: "parameters" }, element("thead", {}, element("tr", {},
        ...["parameter", "value", "unit", "bound", "trust"].map((title) => element("th", { scope: "col" }, title)))), body));
  }

  update(now_s) {
    const newest = this.store.round(this.node, "Estimate", "parameter", now_s);
    for (const [number, row] of newest) {
      const { signal, cells } = this.rows.get(this.store.word("Estimate", "parameter", number)) ?? {};
      if (!signal) continue;
      const texts = [significant(row[signal]), row.error_bound >= 6.5 ? "> 650 %" : `± ${fixed(100 * row.error_bound, 0)} %`,
        row.trusted ? "✓ trusted" : "not yet"];
      cells.forEach((cell, i) => show(cell, texts[i]));
      cells[2].classList.toggle("yes", row.trusted === 1);
    }
  }
}
