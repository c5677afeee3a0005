// One line that says whether the data shown is live, and if not, since when and why.

import { show } from "./dom.js";
import { bus_time, duration } from "./format.js";

// A board sends a hundred frames in this time.
const SILENT_MS = 1500;

export class StatusLine {
  constructor(place, stream, store, view, is_log) {
    Object.assign(this, { place, store, view, is_log, problem: null, received_ms: null });
    [this.word, this.text] = [place.querySelector("b"), place.querySelector("span")];
    // Frames in flight may arrive after the message that the source is lost.
    stream.addEventListener("batch", () => (this.received_ms = performance.now()));
    stream.addEventListener("open", () => this.#clear());
    stream.addEventListener("found", () => this.#clear());
    stream.addEventListener("lost", ({ detail }) => this.#problem("source lost", detail?.reason));
    stream.addEventListener("closed", () => this.#problem("connection lost", "supercoil monitor does not answer"));
  }

  #clear() {
    this.problem = null;
    this.received_ms ??= performance.now();
  }

  #problem(word, why) {
    if (this.problem?.word !== word) this.problem = { word, why, since_ms: this.received_ms ?? performance.now() };
  }

  update() {
    const { kind, word, text } = this.#now();
    this.place.dataset.kind = kind;
    show(this.word, word);
    show(this.text, text);
  }

  #now() {
    const now_ms = performance.now();
    const since = (from_ms) => `since ${duration((now_ms - from_ms) / 1e3)}`;
    if (this.problem) return { kind: "lost", word: this.problem.word, text: `${since(this.problem.since_ms)}${this.problem.why ? `: ${this.problem.why}` : ""}` };
    if (this.received_ms === null && this.store.empty) return { kind: "wait", word: "connecting", text: "" };
    const at = bus_time(this.view.range.to_s);
    if (!this.view.live) return { kind: "paused", word: "paused", text: `at ${at}` };
    if (this.is_log) return { kind: "log", word: "log", text: at };
    if (now_ms - this.received_ms > SILENT_MS) return { kind: "lost", word: "no frames", text: since(this.received_ms) };
    return { kind: "live", word: "live", text: at };
  }
}
