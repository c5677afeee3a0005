// The active controller's gains; an adaptive controller changes them.

import { element, place, scrolling, show } from "./dom.js";
import { significant, words } from "./format.js";

// "" multiplies power, position and reference in watts at rest.
const UNITS = {
  proportional: "W/m", integral: "W/(m·s)", derivative: "W·s/m", feedforward: "W/m", feedforward_velocity: "W·s/m",
  feedforward_acceleration: "W·s²/m", feedforward_jerk: "W·s³/m", bias: "W",
};

export class Gains {
  constructor(node, store) {
    Object.assign(this, { node, store, rows: new Map() });
    this.body = element("tbody");
    this.none = element("p", { class: "hint" }, "This controller has none.");
    this.element = element("section", { class: "card full-only", "aria-label": `gains of the controller, node ${node}` },
      element("h2", {}, "Gains of the controller"), this.none,
      scrolling(`table of the gains, node ${node}`, element("table", { class: "parameters" }, element("thead", {}, element("tr", {},
        ...["gain", "value", "unit"].map((title) => element("th", { scope: "col" }, title)))), this.body)));
  }

  update(now_s) {
    const newest = this.store.round(this.node, "Gain", "gain", now_s);
    newest.delete(0);
    for (const [number, row] of this.rows) row.hidden = !newest.has(number);
    for (const number of [...newest.keys()].sort((a, b) => a - b)) show(this.#row(number).cells[1], significant(newest.get(number).value));
    this.none.hidden = newest.size > 0;
  }

  #row(number) {
    if (!this.rows.has(number)) {
      const name = this.store.word("Gain", "gain", number);
      const row = element("tr", {}, element("th", { scope: "row" }, words(name)), element("td", { class: "value" }),
        element("td", { class: "unit" }, UNITS[name] ?? ""));
      place(this.body, number, row);
      this.rows.set(number, row);
    }
    return this.rows.get(number);
  }
}
