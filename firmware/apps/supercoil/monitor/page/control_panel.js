// The panel that commands a muscle: state, arm, mode, set point.

import { element, show } from "./dom.js";
import { LENGTH, measure_of, same_joint } from "./joint.js";

// Used until the board reports its limits: the stroke and the power of the paper's muscle.
const USUAL = { position: 0.02, power: 4.5 };
const MODES = {
  position: { opcode: "position", button: "move", unit: LENGTH.unit, to_board: LENGTH.to_m, of_board: LENGTH.of_m, steps: [0.01, 0.1, 0.5, 1, 5], step: 0.1, label: "Position",
    hint: "The controller makes the muscle follow this position." },
  power: { opcode: "power", button: "heat", unit: "W", to_board: (W) => W, of_board: (W) => W, steps: [0.01, 0.05, 0.1, 0.5], step: 0.05, label: "Power",
    hint: "Open loop: the muscle gets this power, within its limits." },
  rest: { opcode: "rest", button: "rest", hint: "No power; the muscle cools and stays armed." },
  identify: { opcode: "identify", button: "identify", hint: "Excites the muscle and learns its parameters." },
  calibrate: { opcode: "calibrate", button: "calibrate", hint: "Finds zero and cold resistance; the muscle must be cold." },
};

/** The modes of a muscle in a joint, which the agonist's node commands. */
function modes_in(joint) {
  const { lever_m, other } = joint;
  const { unit, to_m, of_m, min_m } = measure_of(joint);
  const position = lever_m > 0
    ? { ...MODES.position, unit, to_board: to_m, of_board: of_m, min: min_m, steps: [0.05, 0.1, 0.5, 1, 5], step: 0.5, label: "Angle",
      hint: "The controller makes the joint follow this angle." }
    : { ...MODES.position, hint: `Node ${other} commands the joint; a position is refused here.` };
  const power = lever_m > 0 ? MODES.power
    : { ...MODES.power, hint: `How hard both muscles pull while the joint follows node ${other}; otherwise this muscle alone gets this power.` };
  return { ...MODES, position, power };
}

/** The modes of a muscle that follows in a bundle, which the leader's node commands. */
function modes_of_follower(leader) {
  const hint = `Node ${leader} leads the bundle and commands all its muscles; commands that heat are refused here.`;
  return Object.fromEntries(Object.entries(MODES).map(([mode, its]) => [mode, mode === "rest" ? { ...its, hint: "No power to any muscle of the bundle; they cool and stay armed." } : { ...its, hint }]));
}

export class ControlPanel {
  /** may: {command: whether commands are allowed, why: the reason if not}; log(text, kind): called for each command. */
  constructor(manual, may, log) {
    Object.assign(this, { manual, may, log, modes: MODES, mode: "position", values: {}, steps: {}, limits: new Map() });
    const id = (name) => `${name}-${manual.node}`;
    this.arm = this.#button("arm", "arm");
    this.disarm = this.#button("disarm", "disarm");
    this.reset = this.#button("reset fault", "reset");
    this.radios = Object.keys(MODES).map((mode) => {
      const radio = element("input", { type: "radio", name: id("mode"), value: mode, checked: mode === this.mode,
        disabled: !may.command, onchange: () => this.#choose(mode) });
      return element("label", {}, radio, element("span", {}, mode));
    });
    this.number = element("input", { type: "number", id: id("value"), disabled: !may.command, value: "0", inputmode: "decimal" });
    this.unit = element("span", { class: "unit" });
    this.number_label = element("label", { for: id("value") });
    this.slider = element("input", { type: "range", "aria-label": "set point", disabled: !may.command, value: "0",
      oninput: () => (this.number.value = this.slider.value), onchange: () => this.#go() });
    this.number.addEventListener("input", () => (this.slider.value = this.number.value));
    this.step = element("select", { "aria-label": "step of the set point", disabled: !may.command, onchange: () => this.#take_step() });
    this.go = element("button", { type: "submit", class: "go", disabled: !may.command });
    this.hint = element("p", { class: "hint" });
    this.value_row = element("div", { class: "value" }, this.number_label, this.number, this.unit, this.step);
    this.answer = element("p", { class: "answer", role: "status", "aria-label": "answer of the board" });
    this.notice = element("p", { class: "notice", role: "alert", hidden: true });
    const form = element("form", { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#go(); } },
      element("div", { class: "set" }, this.value_row, this.go), this.slider, this.hint);
    this.element = element("section", { class: "card manual full-only", "aria-label": `command node ${manual.node}` },
      element("h2", {}, "Manual control"),
      may.command ? "" : element("p", { class: "why" }, may.why),
      element("div", { class: "buttons" }, this.arm, this.disarm, this.reset),
      element("fieldset", { class: "modes" }, element("legend", {}, "mode"), ...this.radios),
      form, this.answer, this.notice);
    manual.addEventListener("notice", () => {
      show(this.notice, manual.notice);
      this.notice.hidden = manual.notice === "";
      this.notice.classList.toggle("calm", !manual.alarming);
      if (manual.notice) log(manual.notice, manual.alarming ? "warn" : "");
    });
    this.#choose(this.mode);
  }

  #button(text, opcode) {
    return element("button", { type: "button", class: opcode, disabled: !this.may.command, onclick: () => this.#send(opcode) }, text);
  }

  /** Millimetres are not watts: each mode has its own number. */
  #choose(mode) {
    this.values[this.mode] = this.number.value;
    this.mode = mode;
    const { button, hint, unit, label, steps, step } = this.modes[mode];
    show(this.go, button);
    show(this.hint, hint);
    this.value_row.hidden = this.slider.hidden = !unit;
    if (!unit) return;
    show(this.unit, unit);
    show(this.number_label, label);
    const chosen = this.steps[mode] ?? step;
    this.step.replaceChildren(...steps.map((size) => element("option", { value: size, selected: size === chosen }, `± ${size}`)));
    this.#scale();
    this.number.value = this.slider.value = this.values[mode] ?? "0";
  }

  /** Number and slider end at the detector's limit, if the board has reported it. */
  #scale() {
    const { of_board, steps: [finest], opcode, min } = this.modes[this.mode];
    const limit = this.limits.get(opcode === "position" ? "over_travel" : "power_limit_exceeded") ?? USUAL[opcode];
    const step = Number(this.step.value);
    const whole = (reached, unit) => (Math.floor(reached / unit) * unit).toFixed(2);
    const reach = (unit) => whole(of_board(limit), unit), back = (unit) => -whole(-of_board(min(limit)), unit);
    Object.assign(this.number, { step, max: reach(finest) });
    this.min = min ? back(finest) : 0;
    // Inputs count steps from their minimum, and 0 must be a step: the slider's minimum is a multiple of the step, and
    // the number has no minimum.
    if (min) {
      this.number.removeAttribute("min");
      Object.assign(this.slider, { min: back(step), step, max: reach(step) });
    } else {
      this.number.min = 0;
      Object.assign(this.slider, { min: 0, step, max: reach(finest) });
    }
  }

  #take_step() {
    this.steps[this.mode] = Number(this.step.value);
    this.#scale();
  }

  /** One step up (1) or down (-1), sent at once, within the limits. */
  nudge(sign) {
    if (!this.may.command || !this.modes[this.mode].unit) return;
    const wanted = (this.number.valueAsNumber || 0) + sign * Number(this.step.value);
    this.number.value = this.slider.value = Number(Math.min(Math.max(wanted, this.min), Number(this.number.max)).toFixed(2));
    this.#go();
  }

  #go() {
    const { opcode, unit, to_board } = this.modes[this.mode];
    if (!unit) return this.#send(opcode);
    const value = this.number.valueAsNumber;
    if (Number.isNaN(value)) return this.#answer("a number is missing", false);
    if (value < this.min || value > Number(this.number.max)) return this.#answer(`allowed: ${this.min} to ${this.number.max} ${unit}`, false);
    this.#send(opcode, to_board(value), `${this.number.value} ${unit}`);
  }

  async #send(opcode, value = 0, value_text = "") {
    const what = value_text ? `${opcode} ${value_text}` : opcode;
    this.#answer(`${what} …`, true);
    const { obeyed, text } = await this.manual.send(opcode, value);
    this.#answer(`${what}: ${text}`, obeyed);
    this.log(`${what}: ${text}`, obeyed ? "" : "warn");
  }

  #answer(text, obeyed) {
    show(this.answer, text);
    this.answer.classList.toggle("refused", !obeyed);
  }

  /** Once the muscle turns out to be in a joint, its numbers are angles. */
  #take_joint(joint) {
    if (!joint || same_joint(joint, this.joint)) return;
    this.joint = joint;
    this.modes = modes_in(joint);
    Object.assign(this, { values: {}, steps: {} });
    this.number.value = "0";
    this.#choose(this.mode);
  }

  #take_leader(leader) {
    if (leader === null || leader === this.leader) return;
    this.leader = leader;
    this.modes = modes_of_follower(leader);
    this.#choose(this.mode);
  }

  /** status: the channel's own status, in words, or null; joint, leader: from joint_of(), leader_of(). Highlights the
      sensible next step. */
  update(status, limits, joint, leader) {
    if (status) this.manual.observe(status);
    this.#take_joint(joint);
    this.#take_leader(leader);
    for (const [button, state] of [[this.arm, "disarmed"], [this.reset, "fault"]])
      button.classList.toggle("next", status?.state === state);
    this.go.classList.toggle("next", status?.state === "armed");
    // The same map is filled again each time.
    const grown = limits.size !== this.known_limits;
    Object.assign(this, { limits, known_limits: limits.size });
    if (grown && this.modes[this.mode].unit) this.#scale();
  }
}
