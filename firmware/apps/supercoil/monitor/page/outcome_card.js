// What happened in the time shown, in words.

import { element, show } from "./dom.js";
import { cycle_text, infeasible_text, limits_text, never_armed_text, oscillation_text } from "./outcome.js";

// Reads all data shown, so less often when that is an hour: the plots must not wait for it.
const every_ms = (span_s) => Math.max(2000, 5 * span_s);

export class OutcomeCard {
  /** infeasible: the rule for infeasible references, from /api/about. */
  constructor(node, store, view, infeasible) {
    Object.assign(this, { node, store, view, updated_ms: -Infinity });
    this.lines = [limits_text, (...shown) => infeasible_text(...shown, infeasible), never_armed_text, oscillation_text, cycle_text].map((text_of) => ({ text_of, line: element("p") }));
    this.none = element("p", { class: "hint" }, "Armed, at no limit, and not oscillating by itself.");
    this.element = element("section", { class: "card full-only outcome", "aria-label": `what was, node ${node}` },
      element("h2", {}, "In the time shown"), this.none, ...this.lines.map(({ line }) => line));
    view.addEventListener("change", () => (this.updated_ms = -Infinity));
  }

  update() {
    if (performance.now() - this.updated_ms < every_ms(this.view.span_s) || !this.element.checkVisibility()) return;
    this.updated_ms = performance.now();
    const { range } = this.view;
    for (const { text_of, line } of this.lines) {
      show(line, text_of(this.store, this.node, range));
      line.hidden = line.textContent === "";
    }
    this.none.hidden = this.lines.some(({ line }) => !line.hidden);
  }
}
