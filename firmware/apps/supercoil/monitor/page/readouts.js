// The newest numbers of a node, large.

import { element, show } from "./dom.js";
import { AGES, fixed, is_old, measured_ago } from "./format.js";

const NUMBERS = [
  ["position", "mm", 3, "Measurement", "position_m", 1e3],
  ["reference", "mm", 3, "Tracking", "reference_m", 1e3],
  ["error", "µm", 0, "Tracking", "error_m", 1e6],
  ["power", "W", 3, "Power", "applied_W", 1],
  ["resistance", "Ω", 3, "Measurement", "resistance_Ohm", 1],
  ["supply", "V", 2, "Heater", "supply_V", 1],
];

export class Readouts {
  constructor(node, store) {
    Object.assign(this, { node, store });
    this.values = NUMBERS.map(() => element("b", {}, "–"));
    this.temperature = element("b", {}, "–");
    const tile = (name, value, unit, kind) => element("div", { class: kind }, element("dt", {}, name), element("dd", {}, value, element("span", {}, ` ${unit}`)));
    const tiles = NUMBERS.map(([name, unit], i) => tile(name, this.values[i], unit));
    tiles.splice(4, 0, tile("temperature", this.temperature, "°C", "interval"));
    this.element = element("dl", { class: "readouts", "aria-label": `newest values of node ${node}` }, ...tiles);
  }

  update(now_s) {
    NUMBERS.forEach(([, , decimals, message, column, factor], i) => {
      const row = this.store.at(this.node, message, now_s);
      show(this.values[i], fixed(row?.[column] * factor, decimals));
      const age_s = row && AGES[column] ? row[AGES[column]] : 0;
      this.values[i].classList.toggle("old", is_old(age_s));
      this.values[i].title = is_old(age_s) ? measured_ago(age_s) : "";
    });
    const row = this.store.at(this.node, "Temperature", now_s);
    show(this.temperature, `${fixed(row?.coldest_C, 1)} … ${fixed(row?.hottest_C, 1)}`);
  }
}
