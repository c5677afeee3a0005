// The dialog in which the user chooses the quantities of each plot.

import { element } from "./dom.js";
import { choose, choose_usual, chosen_plots, quantities_of } from "./plot_choice.js";
import { PLOTS } from "./plots.js";

export class PlotDialog {
  /** on_change: called when the choice changed. */
  constructor(dialog, protocol, on_change) {
    Object.assign(this, { dialog, protocol, on_change });
    this.body = dialog.querySelector("div");
    const [close, usual] = dialog.querySelectorAll("button");
    close.addEventListener("click", () => dialog.close());
    usual.addEventListener("click", () => {
      choose_usual();
      this.#fill();
      on_change();
    });
  }

  toggle() {
    if (this.dialog.open) return this.dialog.close();
    this.#fill();
    this.dialog.show();
  }

  #fill() {
    const shown = new Map(chosen_plots(this.protocol).map((spec) => [spec.title, spec.lines]));
    this.body.replaceChildren(...PLOTS.map((spec) => {
      const boxes = quantities_of(spec, this.protocol).map((line) => {
        const checked = shown.get(spec.title)?.some(({ message, column }) => message === line.message && column === line.column);
        return { line, input: element("input", { type: "checkbox", checked, onchange: () => {
          choose(spec.title, boxes.filter(({ input }) => input.checked).map((box) => box.line));
          this.on_change();
        } }) };
      });
      return element("div", { role: "group", "aria-label": spec.title }, element("h3", {}, `${spec.title} `, element("span", { class: "unit" }, spec.unit)),
        ...boxes.map(({ line, input }) => element("label", { class: "choice" }, input, ` ${line.name}`)));
    }));
  }
}
