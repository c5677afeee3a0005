// The row of buttons for another run drawn under the current one.

import { element, show } from "./dom.js";
import { bus_time } from "./format.js";
import { batch_of_csv, batch_of_store } from "./other_run.js";

export class RunBar {
  /** nodes: a function that returns the visible ones; run: an OtherRun. */
  constructor(place, run, store, view, nodes) {
    this.text = element("span", { role: "status" });
    const file = element("input", { type: "file", accept: ".csv,text/csv", hidden: true, onchange: () => this.#load(run, view, file) });
    const button = (text, title, onclick) => element("button", { type: "button", title, onclick }, text);
    const lay = button("lay over what is shown", "with its start at the left edge of the plots", () => run.begin_at(view.range.from_s));
    const drop = button("drop", "remove the other run", () => run.drop());
    place.append(element("b", {}, "Other run"), this.text,
      button("keep what is shown", "as a run to compare with", () => {
        const { range } = view;
        run.take(batch_of_store(store, nodes(), range), `${bus_time(range.from_s)} to ${bus_time(range.to_s)}`);
      }),
      button("load CSV", "load a previously exported run", () => file.click()), lay, drop, file);
    const update = () => {
      lay.hidden = drop.hidden = !run.store;
      show(this.text, run.store ? `${run.name}, drawn pale` : "none");
    };
    run.addEventListener("change", update);
    update();
  }

  async #load(run, view, file) {
    const [chosen] = file.files;
    if (!chosen) return;
    try {
      run.take(batch_of_csv(await chosen.text()), chosen.name);
      run.begin_at(view.range.from_s);
    } catch (problem) {
      show(this.text, `${chosen.name}, ${problem.message}`);
    }
    file.value = "";
  }
}
