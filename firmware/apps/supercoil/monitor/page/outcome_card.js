// What happened in the time shown, in words.

import { element, show } from "./dom.js";
import { cycle_told, infeasible_told, limits_told, never_armed_told, swing_told } from "./outcome.js";

// Reads all data shown, so less often when that is an hour: the plots must not wait for it.
const every_ms = (span_s) => Math.max(2000, 5 * span_s);

export class OutcomeCard {
  /** infeasible: the rule for infeasible references, from /api/about. */
  constructor(node, store, view, infeasible) {
    Object.assign(this, { node, store, view, told_ms: -Infinity });
    this.lines = [limits_told, (...shown) => infeasible_told(...shown, infeasible), never_armed_told, swing_told, cycle_told].map((tell) => ({ tell, line: element("p") }));
    this.none = element("p", { class: "hint" }, "Armed, at no limit, and not oscillating by itself.");
    this.element = element("section", { class: "card full-only outcome", "aria-label": `what was, node ${node}` },
      element("h2", {}, "In the time shown"), this.none, ...this.lines.map(({ line }) => line));
    view.addEventListener("change", () => (this.told_ms = -Infinity));
  }

  update() {
    if (performance.now() - this.told_ms < every_ms(this.view.span_s) || !this.element.checkVisibility()) return;
    this.told_ms = performance.now();
    const { range } = this.view;
    for (const { tell, line } of this.lines) {
      show(line, tell(this.store, this.node, range));
      line.hidden = line.textContent === "";
    }
    this.none.hidden = this.lines.some(({ line }) => !line.hidden);
  }
}
