// How near each detector is to tripping, as bars.

import { element, place, show } from "./dom.js";
import { significant, words } from "./format.js";

// Units as in docs/faults; "" is a count or a flag.
export const UNITS = {
  sensor_out_of_range: "m", sensor_frozen: "s", sensor_jump: "m", sensors_disagree: "K", heater_open: "A", heater_short: "A",
  heater_stuck_on: "A", heater_not_responding: "m", over_temperature: "°C", over_travel: "m", energy_budget_exceeded: "J",
  resistance_drift: "Ω", muscle_loose: "m", under_voltage: "V", over_voltage: "V", power_limit_exceeded: "W", telemetry_dead: "s",
  command_timeout: "s", bus_off: "s", bus_error_passive: "s", controller_invalid: "s", duty_wrong: "steps",
};
// A supply of 12 V uses 0.91 of its limits and is fine.
const NEAR = 0.95;

export class Margins {
  constructor(node, store, on_fault) {
    Object.assign(this, { node, store, on_fault, bars: new Map(), limits: new Map() });
    this.list = element("ul", { class: "margins" });
    this.element = element("section", { class: "card full-only", "aria-label": `margins of the detectors, node ${node}` },
      element("h2", {}, "Margins of the detectors"),
      element("p", { class: "hint" }, "How much of its limit each has used; at 100 % it trips."), this.list);
  }

  /** Also keeps limits: fault's name → limit, in the detector's unit. */
  update(now_s) {
    this.limits.clear();
    for (const [number, row] of this.store.round(this.node, "Limit", "fault", now_s))
      this.limits.set(this.store.word("Limit", "fault", number), row.limit);
    const margins = this.store.round(this.node, "Margin", "fault", now_s);
    for (const number of [...margins.keys()].sort((a, b) => a - b)) if (number !== 0) this.#show(number, margins.get(number));
  }

  #show(number, { used, measured }) {
    const name = this.store.word("Margin", "fault", number);
    const { item, meter, text } = this.bars.get(number) ?? this.#add(number, name);
    const limit = this.limits.get(name);
    const unit = UNITS[name] ?? "";
    meter.style.setProperty("--used", `${Math.max(0, Math.min(1, used)) * 100}%`);
    meter.setAttribute("aria-valuenow", Number.isFinite(used) ? used.toFixed(2) : "");
    item.className = used >= 1 ? "beyond" : used >= NEAR ? "near" : "";
    const percent = Number.isFinite(used) ? `${Math.round(used * 100)} %` : used > 0 ? "beyond" : "–";
    show(text, percent);
    item.title = `${significant(measured)} of ${significant(limit)} ${unit}`;
    meter.setAttribute("aria-valuetext", `${percent}, ${item.title}`);
  }

  #add(number, name) {
    const meter = element("span", { class: "meter", role: "meter", "aria-label": words(name), "aria-valuemin": 0, "aria-valuemax": 1 });
    const text = element("span", { class: "used" });
    const item = element("li", {}, element("button", { type: "button", class: "link", onclick: () => this.on_fault(name) }, words(name)), meter, text);
    const bar = { item, meter, text };
    this.bars.set(number, bar);
    place(this.list, number, item);
    return bar;
  }
}
