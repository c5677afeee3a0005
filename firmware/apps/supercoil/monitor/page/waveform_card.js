// A waveform to play on a muscle: its shape, its numbers or its file, start and stop.

import { element, show } from "./dom.js";
import { LENGTH } from "./joint.js";
import { jumps, swinging, through } from "./trajectory.js";
import { TrajectoryPlayer } from "./trajectory_player.js";
import { WavePlayer } from "./wave_player.js";
import { SHAPES, refuse_values, waveform, waveform_of_file } from "./waveform.js";

export class WaveformCard {
  /** may: {command, why}; log(text, kind): called for each action; position(): where the muscle is, in m. */
  constructor(manual, may, log, position) {
    const [set_points, trajectory] = [new WavePlayer(manual), new TrajectoryPlayer(manual, position)];
    Object.assign(this, { log, max_m: NaN, measure: LENGTH, shape: "sine", set_points, trajectory, player: trajectory, fields: new Map() });
    const disabled = !may.command;
    const id = (name) => `wave-${name}-${manual.node}`;
    const radios = Object.keys(SHAPES).map((shape) => element("label", {},
      element("input", { type: "radio", name: id("shape"), value: shape, checked: shape === this.shape, disabled, onchange: () => this.#choose(shape) }),
      element("span", {}, shape)));
    // Inputs of all shapes; only those of the chosen shape are visible.
    for (const [name, [label, unit, value]] of Object.entries(Object.assign({}, ...Object.values(SHAPES)))) {
      const input = element("input", { type: "number", id: id(name), step: "any", inputmode: "decimal", value, disabled });
      const unit_shown = element("span", { class: "unit" }, unit || LENGTH.unit);
      this.fields.set(name, { input, typed_unit: unit ? null : unit_shown, row: element("div", { class: "value" }, element("label", { for: id(name) }, label), input, unit_shown) });
    }
    this.file = element("input", { type: "file", accept: ".csv,text/csv", "aria-label": "file of the waveform", disabled });
    this.file_row = element("div", {}, this.file, element("p", { class: "hint" }, "CSV with the columns time_s and position_m; smooth through its rows as a trajectory, straight between them as set points."));
    this.by_set_points = element("input", { type: "checkbox", disabled, onchange: () => this.#choose(this.shape) });
    this.choice = element("label", { class: "choice" }, this.by_set_points, element("span", {}, "as set points"));
    this.way = element("p", { class: "hint" });
    this.stop_button = element("button", { type: "button", disabled: true, onclick: () => this.player.hold("stopped; the last set point holds") }, "stop");
    this.answer = element("p", { class: "answer", role: "status", "aria-label": "answer about the waveform" });
    const form = element("form", { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#start(); } },
      element("fieldset", { class: "modes" }, element("legend", {}, "shape"), ...radios),
      ...[...this.fields.values()].map(({ row }) => row), this.file_row, this.choice, this.way,
      element("div", { class: "buttons" }, element("button", { type: "submit", disabled }, "start"), this.stop_button));
    this.element = element("details", { class: "card full-only waveform", "aria-label": `waveform for node ${manual.node}` },
      element("summary", {}, element("h2", {}, "Waveform")), form, this.answer);
    for (const player of [set_points, trajectory]) {
      player.addEventListener("progress", ({ detail }) => this.#show_message(`${this.shape}: ${detail}`));
      player.addEventListener("stop", ({ detail }) => {
        this.stop_button.disabled = true;
        this.#show_message(`${this.shape}: ${detail}`);
        log(`waveform ${this.shape}: ${detail}`);
      });
    }
    this.#choose(this.shape);
  }

  #choose(shape) {
    this.player.hold("another shape or mode was chosen; the last set point holds");
    this.shape = shape;
    for (const [name, { row }] of this.fields) row.hidden = !(name in SHAPES[shape]);
    this.file_row.hidden = shape !== "file";
    this.choice.hidden = shape === "steps";
    this.#show_choice(shape === "steps" ? "it jumps" : this.by_set_points.checked ? "it was chosen" : "");
  }

  async #start() {
    try {
      const { wave, motion } = await this.#wave();
      const why = this.by_set_points.checked && this.shape !== "steps" ? "it was chosen" : motion.why;
      this.player.stop("another one starts");
      this.player = why ? this.set_points : this.trajectory;
      this.player.start(why ? wave : motion, this.max_m);
      this.stop_button.disabled = false;
      this.#show_choice(why);
      this.log(`waveform ${this.shape}: started ${why ? "as set points" : "as a trajectory"}`);
    } catch (problem) {
      this.#show_message(problem.message, true);
    }
  }

  /** why: the reason for playing it as set points; "" or undefined: as a trajectory. */
  #show_choice(why) {
    show(this.way, why ? `As set points, 20 per second: ${why}.` : "As a trajectory: the board gets the motion ahead of time.");
  }

  /** What to play, as set points and as a trajectory, or why not; throws what is wrong with it. */
  async #wave() {
    if (!(this.max_m > 0)) throw new Error("the board has not reported yet how far its muscle may travel");
    if (this.shape === "file") {
      const [file] = this.file.files;
      if (!file) throw new Error("choose a file first");
      const wave = waveform_of_file(await file.text(), this.max_m, this.measure);
      return { wave, motion: through(wave.rows, wave.at) };
    }
    const values = Object.fromEntries([...this.fields].map(([name, { input }]) => [name, input.valueAsNumber]));
    const why = refuse_values(this.shape, values, this.max_m, this.measure);
    if (why) throw new Error(why);
    const wave = waveform(this.shape, values, this.measure);
    const no_way = jumps(this.shape, values);
    return { wave, motion: no_way ? { why: no_way } : swinging(this.shape, values, this.measure) };
  }

  #show_message(text, refused = false) {
    show(this.answer, text);
    this.answer.classList.toggle("refused", refused);
  }

  /** limits: of the detectors, by fault; measure: the unit in which positions are typed. */
  update(limits, measure) {
    this.max_m = limits.get("over_travel");
    const same = measure.unit === this.measure.unit;
    this.measure = measure;
    if (same) return;
    for (const { typed_unit } of this.fields.values()) if (typed_unit) show(typed_unit, measure.unit);
    // A small swing around the middle of the range.
    if (measure.both_ways) [this.fields.get("offset").input.value, this.fields.get("amplitude").input.value] = [0, 5];
  }
}
