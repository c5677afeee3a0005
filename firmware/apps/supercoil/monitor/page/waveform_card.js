// A waveform to be played to a muscle: its shape, its numbers or its file, start and stop.

import { element, show } from "./dom.js";
import { fixed } from "./format.js";
import { WavePlayer } from "./wave_player.js";
import { SHAPES, refuse_values, waveform, waveform_of_file } from "./waveform.js";

export class WaveformCard {
  /** may: {command, why}; log: is told (text, kind) of what was done. */
  constructor(manual, may, log) {
    Object.assign(this, { log, most_m: NaN, shape: "sine", player: new WavePlayer(manual), fields: new Map() });
    const disabled = !may.command;
    const id = (name) => `wave-${name}-${manual.node}`;
    const radios = Object.keys(SHAPES).map((shape) => element("label", {},
      element("input", { type: "radio", name: id("shape"), value: shape, checked: shape === this.shape, disabled, onchange: () => this.#choose(shape) }),
      element("span", {}, shape)));
    // Of all shapes; those of the chosen one are seen.
    for (const [name, [label, unit, value]] of Object.entries(Object.assign({}, ...Object.values(SHAPES)))) {
      const input = element("input", { type: "number", id: id(name), step: "any", inputmode: "decimal", value, disabled });
      this.fields.set(name, { input, row: element("div", { class: "value" }, element("label", { for: id(name) }, label), input, element("span", { class: "unit" }, unit)) });
    }
    this.file = element("input", { type: "file", accept: ".csv,text/csv", "aria-label": "file of the waveform", disabled });
    this.file_row = element("div", {}, this.file, element("p", { class: "hint" }, "CSV with the columns time_s and position_m; straight between its rows."));
    this.stop_button = element("button", { type: "button", disabled: true, onclick: () => this.player.stop("stopped; the last set point holds") }, "stop");
    this.answer = element("p", { class: "answer", role: "status", "aria-label": "answer about the waveform" });
    const form = element("form", { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#start(); } },
      element("fieldset", { class: "modes" }, element("legend", {}, "shape"), ...radios),
      ...[...this.fields.values()].map(({ row }) => row), this.file_row,
      element("div", { class: "buttons" }, element("button", { type: "submit", disabled }, "start"), this.stop_button));
    this.element = element("details", { class: "card full-only waveform", "aria-label": `waveform for node ${manual.node}` },
      element("summary", {}, element("h2", {}, "Waveform")), form, this.answer);
    this.player.addEventListener("progress", () => this.#say(`${this.shape}: ${fixed(this.player.time_s, 1)} s`));
    this.player.addEventListener("stop", ({ detail }) => {
      this.stop_button.disabled = true;
      this.#say(`${this.shape}: ${detail}`);
      log(`waveform ${this.shape}: ${detail}`);
    });
    this.#choose(this.shape);
  }

  #choose(shape) {
    this.player.stop("another shape was chosen");
    this.shape = shape;
    for (const [name, { row }] of this.fields) row.hidden = !(name in SHAPES[shape]);
    this.file_row.hidden = shape !== "file";
  }

  async #start() {
    try {
      const wave = await this.#wave();
      this.player.start(wave);
      this.stop_button.disabled = false;
      this.log(`waveform ${this.shape}: started`);
    } catch (problem) {
      this.#say(problem.message, true);
    }
  }

  /** What is to be played; throws what is wrong with it. */
  async #wave() {
    if (!(this.most_m > 0)) throw new Error("the board has not told yet how far its muscle may travel");
    if (this.shape === "file") {
      const [file] = this.file.files;
      if (!file) throw new Error("choose a file first");
      return waveform_of_file(await file.text(), this.most_m);
    }
    const values = Object.fromEntries([...this.fields].map(([name, { input }]) => [name, input.valueAsNumber]));
    const why = refuse_values(this.shape, values, this.most_m);
    if (why) throw new Error(why);
    return waveform(this.shape, values);
  }

  #say(text, refused = false) {
    show(this.answer, text);
    this.answer.classList.toggle("refused", refused);
  }

  /** limits: of the detectors, by fault. */
  update(limits) {
    this.most_m = limits.get("over_travel");
  }
}
