// A channel's own status: state as a colour and a word, mode, progress, fault.

import { element, show } from "./dom.js";
import { duration, fixed, significant, words } from "./format.js";
import { UNITS } from "./margins.js";
import { result_words } from "./results.js";
import { TimeLeft } from "./time_left.js";

// A heartbeat comes every 100 ms.
const SILENT_S = 1;
const MEANS = {
  disarmed: "off, cannot heat",
  armed: "off, ready to heat",
  active: "heats",
  fault: "off, needs a reset",
};
// At this temperature, contact for hours burns skin (docs/safety.md).
const HOT_C = 43;

/** How hot the muscle may be, by its upper bound: off is not cold. */
function how_hot(state, hottest_C) {
  if (!Number.isFinite(hottest_C)) return "temperature not known";
  const whole_C = fixed(Math.ceil(hottest_C), 0);
  return hottest_C < HOT_C ? `at most ${whole_C} °C` : `may ${state === "active" ? "" : "still "}be at ${whole_C} °C`;
}

/** 0.2.0 (2780ebf), as the board reports it; older boards do not. */
function program_text(row) {
  if (!row) return "–";
  const commit = row.commit === 0 ? "" : ` (${row.commit.toString(16).padStart(7, "0")})`;
  return `${row.version_major}.${row.version_minor}.${row.version_patch}${commit}`;
}

export class StateCard {
  /** on_fault: called with a fault's name to open its page. version: of the protocol that this page understands. */
  constructor(node, store, on_fault, version, kind_of = () => undefined) {
    Object.assign(this, { node, store, version, fault_name: "none", kind_of });
    this.word = element("strong", { class: "word", role: "status" });
    this.means = element("span", { class: "means" });
    this.facts = element("dl", { class: "facts" });
    this.values = ["mode", "controller", "commanded by", "limited by", "program"].map((name) => {
      const value = element("dd", {}, "–");
      this.facts.append(element("div", {}, element("dt", {}, name), value));
      return value;
    });
    this.bar = element("progress", { max: 1, "aria-label": "progress" });
    this.percent = element("span");
    this.time_left = new TimeLeft();
    this.progress = element("p", { class: "progress", hidden: true }, this.bar, " ", this.percent);
    this.result = element("p", { class: "hint", role: "status", hidden: true });
    this.fault_button = element("button", { type: "button", class: "link", onclick: () => on_fault(this.fault_name) });
    this.fault = element("p", { class: "fault", role: "alert", hidden: true }, this.fault_button);
    this.foreign = element("p", { class: "foreign", role: "alert", hidden: true });
    this.unproven = element("p", { class: "foreign", hidden: true },
      "No proof of response (proof_of_response is false, or this muscle is one of a joint's two or follows in a bundle): a muscle detached from its sensor may overheat undetected.");
    this.oscillated = element("p", { class: "foreign", hidden: true },
      "The control loop oscillated by itself: its feedback is slower now. Identify the muscle, or lower the controller's bandwidth or gains.");
    this.slack = element("p", { class: "foreign", hidden: true },
      "According to its model this muscle is slack at the present joint angle: the other muscle or the load alone moves the joint. More co-contraction makes it taut.");
    this.element = element("section", { class: "card state", "aria-label": `state of node ${node}` },
      element("h2", {}, `Node ${node}`),
      element("p", { class: "now" }, this.word, " ", this.means), this.foreign, this.unproven, this.oscillated, this.slack, this.fault, this.progress, this.result, this.facts);
  }

  /** Returns the status in words, or null if there is none. */
  update(now_s) {
    const row = this.store.at(this.node, "Status", now_s);
    const name = (signal) => this.store.word("Status", signal, row[signal]);
    const silent_s = row ? now_s - row.time_s + this.store.silent_s : Infinity;
    const status = row && { state: silent_s > SILENT_S ? "silent" : name("state"), mode: name("mode"), fault: name("fault"), controller: row.controller, time_s: row.time_s };
    const state = status?.state ?? "silent";
    this.element.dataset.state = state;
    show(this.word, state);
    show(this.means, state in MEANS ? `${MEANS[state]}; ${how_hot(state, this.#hottest_C(now_s))}`
      : row ? `was ${name("state")}; no heartbeat since ${duration(silent_s)}` : "its heartbeat was never heard");
    const facts = row
      ? [name("mode"), `${this.kind_of(row.controller) ?? `number ${row.controller}`}${row.trusted ? ", estimates trusted" : ""}`, row.leased ? "a master on the bus" : "nobody on the bus",
        row.limited || name("limited_by") === "cooling" ? words(name("limited_by")).replace("nothing", "supply or probe") : "nothing", program_text(this.store.at(this.node, "Boot", now_s))]
      : ["–", "–", "–", "–", "–"];
    this.values.forEach((value, i) => show(value, facts[i]));
    this.#show_fault(status, row, now_s);
    this.unproven.hidden = row?.proof_off !== 1;
    this.oscillated.hidden = row?.oscillated !== 1;
    this.slack.hidden = row?.slack !== 1;
    this.foreign.hidden = !row || row.protocol_version === this.version;
    if (!this.foreign.hidden) {
      show(this.foreign, `It speaks version ${row.protocol_version} of the protocol, this page ${this.version}: ` +
        "numbers may be wrong. Use the matching version of supercoil.");
    }
    const shows = status && (status.mode === "identify" || status.mode === "calibrate") && Number.isFinite(row.progress);
    this.progress.hidden = !shows;
    if (!shows) this.time_left.forget();
    if (shows) {
      this.bar.value = row.progress;
      show(this.percent, `${status.mode}: ${fixed(100 * row.progress, 0)} %${this.time_left.text(status.mode, row.time_s, row.progress)}`);
    }
    const by = row ? this.#interrupted_by(name("result"), status) : "";
    const result = status && !shows ? name("result") : "none";
    const notes = this.store.at(this.node, "Estimate", now_s)?.identify_notes ?? 0;
    const text = result_words(result, by, notes, row?.friction === 1);
    this.result.hidden = text === "";
    if (text !== "") show(this.result, `Last identify or calibrate: ${text}.`);
    return status;
  }

  /** What interrupted it. Only the heartbeat right after "running" tells; a later one may refer to something else. */
  #interrupted_by(result, { state, fault }) {
    const ended = this.result_before === "running";
    this.result_before = result;
    if (result !== "interrupted") this.by = "";
    else if (ended) this.by = fault !== "none" ? ` by the fault ${words(fault)}` : state === "disarmed" ? ": it was disarmed" : " by another command";
    else this.by ||= " by a command or a fault";
    return this.by;
  }

  #hottest_C(now_s) {
    const row = this.store.at(this.node, "Temperature", now_s);
    return row && now_s - row.time_s <= SILENT_S ? row.hottest_C : NaN;
  }

  /** What the fault's detector measured when it tripped, and its limit; sent once, right after the emergency. */
  #margin(fault, now_s) {
    const emergency = this.store.at(this.node, "Emergency", now_s);
    const cause = this.store.at(this.node, "FirstCause", now_s);
    if (!cause || emergency?.fault !== fault || cause.time_s < emergency.time_s) return "";
    return ` (measured ${significant(cause.measured)}, limit ${significant(cause.limit)} ${UNITS[this.fault_name] ?? ""}`.trimEnd() + ")";
  }

  #show_fault(status, row, now_s) {
    this.fault_name = status?.fault ?? "none";
    this.fault.hidden = this.fault_name === "none";
    if (!this.fault.hidden) show(this.fault_button, `fault ${row.fault}: ${words(this.fault_name)}${this.#margin(row.fault, now_s)} – what to do`);
  }
}
