// The controllers and estimators of a node with all their values: read when opened, changed by hand, stored.

import { element, scrolling, show } from "./dom.js";
import { significant, words } from "./format.js";
import { refusal_words } from "./refusals.js";
import { command, kinds_of, tune, tuning_of } from "./server.js";

const STORE = 2; // of the opcode store: keeps the tuning in use
const CLEAR = 3; // forgets what is stored
const FIRST_ESTIMATOR = 8; // of the places, where controllers begin at 0
const SETS = ["in_use", "configured", "stored"];

const text_of = (value) => (value === null || value === undefined ? "–" : typeof value === "number" ? significant(value) : String(value));

export class Tuning {
  /** may: {command, why}; log(text, kind): called for each action. */
  constructor(node, may, log) {
    Object.assign(this, { node, may, log, all: [], kinds: null, known_at: "", shown: 0, inputs: new Map() });
    this.tabs = element("div", { class: "buttons", role: "group", "aria-label": "controllers and estimators" });
    this.body = element("tbody");
    this.answer = element("p", { class: "answer", role: "status", "aria-label": "answer about the controllers" });
    const button = (text, act) => element("button", { type: "button", disabled: !may.command, onclick: act }, text);
    this.element = element("details", { class: "card full-only", "aria-label": `controllers of node ${node}`, ontoggle: () => this.element.open && this.read() },
      element("summary", {}, element("h2", {}, "Controllers and estimators")), this.tabs,
      element("form", { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#use("in_use", this.#changed()); } },
        scrolling(`values of the controllers, node ${node}`, element("table", { class: "parameters" }, element("thead", {}, element("tr", {},
          ...["value", "in use", "board.toml", "stored", "new"].map((title) => element("th", { scope: "col" }, title)))), this.body)),
        element("div", { class: "buttons" }, element("button", { type: "submit", disabled: !may.command }, "use"),
          button("as board.toml", () => this.#use("configured", {})),
          button("store", () => this.#keep(STORE, "stored for the next start")),
          button("forget stored", () => this.#keep(CLEAR, "the next start uses board.toml")))),
      this.answer);
  }

  /** The law at a place, by name; undefined while it is not known. */
  kind_of(place) {
    return this.kinds?.controllers[place];
  }

  /** Asks for the kinds again when the active ones may have changed: other programs tune as well. */
  follow(status) {
    const now = status && status.state !== "silent" ? `${status.state} ${status.mode} ${status.controller}` : "";
    if (now === this.known_at) return;
    this.known_at = now;
    if (now) kinds_of(this.node).then((kinds) => { this.kinds = kinds; }, () => { this.kinds = null; });
  }

  async read() {
    this.#show_message("reading …");
    try {
      const { controllers, estimators, choices } = await tuning_of(this.node);
      this.all = [...controllers.map((values, place) => ({ what: "controller", number: place, place, values, choices: choices.controllers })),
        ...estimators.map((values, number) => ({ what: "estimator", number, place: FIRST_ESTIMATOR + number, values, choices: choices.estimators }))];
      this.kinds = { controllers: controllers.map(({ kind }) => kind.in_use) };
      this.shown = Math.min(this.shown, this.all.length - 1);
      this.#draw();
      this.#show_message("");
    } catch (problem) {
      this.#show_message(problem.message, true);
    }
  }

  #draw() {
    this.tabs.replaceChildren(...this.all.map(({ what, number, values }, at) => element("button", { type: "button",
      "aria-pressed": String(at === this.shown), onclick: () => { this.shown = at; this.#draw(); } }, `${what} ${number}: ${values.kind.in_use}`)));
    this.inputs.clear();
    const { what, values, choices } = this.all[this.shown];
    this.body.replaceChildren(...Object.entries(values).filter(([name]) => name !== what).map(([name, sets]) => {
      const input = this.#input(name, sets, choices[name]);
      this.inputs.set(name, { input, was: input.value });
      const differs = SETS.some((set) => sets[set] !== sets.configured);
      return element("tr", { class: differs ? "differs" : "" }, element("th", { scope: "row", title: name }, (differs ? "✱ " : "") + words(name)),
        ...SETS.map((set) => element("td", { class: "value" }, text_of(sets[set]))), element("td", {}, input));
    }));
  }

  #input(name, { in_use }, choices) {
    const attributes = { "aria-label": `new ${words(name)}`, disabled: !this.may.command || in_use === null };
    if (!choices) return element("input", { ...attributes, type: "text", inputmode: "decimal", value: in_use ?? "" });
    return element("select", attributes, ...(choices.includes(String(in_use)) ? [] : [element("option", { selected: true }, text_of(in_use))]),
      ...choices.map((choice) => element("option", { selected: choice === String(in_use) }, choice)));
  }

  /** The values that the user changed, by name. */
  #changed() {
    return Object.fromEntries([...this.inputs].filter(([, { input, was }]) => input.value !== was).map(([name, { input }]) => [name, input.value.trim()]));
  }

  async #use(from, values) {
    const what = Object.entries(values).map(([name, value]) => `${name} = ${value}`).join(", ") || (from === "configured" ? "as board.toml" : "no change");
    if (this.all.length === 0) return this.#show_message("the values are not read yet", true);
    const { what: of, number, place } = this.all[this.shown];
    await this.#run(`${of} ${number}: ${what}`, () => tune(this.node, place, from, values), "in use");
  }

  async #keep(value, done) {
    await this.#run("tuning", () => command(this.node, "store", value), done);
  }

  async #run(what, act, done) {
    this.#show_message("…");
    try {
      const refusal = await act();
      const obeyed = refusal === "none";
      const text = `${what}: ${obeyed ? done : `refused: ${refusal_words(refusal)}`}`;
      if (obeyed) await this.read();
      this.#show_message(text, !obeyed);
      this.log(text, obeyed ? "" : "warn");
    } catch (problem) {
      this.#show_message(problem.message, true);
    }
  }

  #show_message(text, refused = false) {
    show(this.answer, text);
    this.answer.classList.toggle("refused", refused);
  }
}
