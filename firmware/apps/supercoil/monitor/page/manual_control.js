// Manual control of one muscle: sends commands, and reports that this page is alive while its command may heat.

import { alive, command, play } from "./server.js";
import { clock_now } from "./format.js";
import { refusal_words } from "./refusals.js";

const ALIVE_PERIOD_MS = 300;
// After an obeyed command the muscle's own state follows within a heartbeat or two.
const SETTLING_MS = 1000;
const HEATS = new Set(["position", "power", "identify", "calibrate"]);
const COOLS = new Set(["rest", "disarm"]);

export class ManualControl extends EventTarget {
  constructor(node, timeout_s) {
    super();
    Object.assign(this, { node, timeout_s, holds: null, since_ms: 0, notice: "", timer: 0, waiting: false, answered_ms: 0, release_count: 0, following: null });
  }

  /** A manual command; it ends a motion that is playing. Resolves to {obeyed, text}. */
  async send(opcode, value = 0) {
    this.dispatchEvent(new Event("taken"));
    await this.following; // a set point in flight must not overtake this command
    return this.#command(opcode, value, true);
  }

  /** One set point of many. Resolves likewise. */
  follow(position_m) {
    return this.#follow(() => this.#command("position", position_m, this.holds !== "position"), { obeyed: false, text: "the muscle was let go" });
  }

  /** Knots of a trajectory, and its start, after a position that is held. Resolves to the board's answer, or to {problem}. */
  play(knots, start) {
    return this.#follow(async () => {
      try {
        const reply = await play(this.node, knots, start);
        this.#note_answer();
        return reply;
      } catch ({ message }) {
        return { problem: message };
      }
    }, { problem: "the muscle was let go" });
  }

  /** Acts after the request in flight, unless the muscle is let go meanwhile. */
  #follow(act, otherwise) {
    const [before, release_count] = [this.following, this.release_count];
    this.following = (async () => {
      await before;
      return release_count === this.release_count ? act() : otherwise;
    })();
    return this.following;
  }

  async #command(opcode, value, begins) {
    const release_count = this.release_count;
    try {
      const refusal = await command(this.node, opcode, value);
      if (refusal !== "none") return { obeyed: false, text: `refused: ${refusal_words(refusal)}` };
    } catch (problem) {
      return { obeyed: false, text: problem.message };
    }
    // A muscle that was let go before the answer came is not held after it.
    if (HEATS.has(opcode) && release_count === this.release_count) this.#hold(opcode, begins);
    if (COOLS.has(opcode)) this.release_hold();
    return { obeyed: true, text: "obeyed" };
  }

  #hold(opcode, begins) {
    this.holds = opcode;
    if (begins) this.since_ms = performance.now();
    this.#note_answer();
    this.#show_message("");
    this.timer ||= setInterval(() => this.#report_alive(), ALIVE_PERIOD_MS);
  }

  /** This page no longer commands anything that heats. */
  release_hold(notice = "", alarming = true) {
    ++this.release_count;
    clearInterval(this.timer);
    this.timer = 0;
    this.holds = null;
    this.dispatchEvent(new Event("release"));
    this.#show_message(notice, alarming);
  }

  /** The board's own state and fault: a mode that has ended, or was ended, is no longer held. */
  observe({ state, fault }) {
    const settled = performance.now() - this.since_ms >= SETTLING_MS;
    if (!this.holds || !settled || state === "active" || state === "silent") return;
    if (fault === "command_timeout") this.release_hold(`command expired: it was not renewed in time (${clock_now()})`);
    else if (state === "armed") this.release_hold(`${this.holds} has ended`, false);
    else this.release_hold(`${this.holds} has ended: the muscle is ${state}`);
  }

  async #report_alive() {
    if (this.waiting) return;
    this.waiting = true;
    try {
      const { holding, reason } = await alive(this.node);
      this.#note_answer();
      if (!holding && this.holds) this.release_hold(`command ${reason} (${clock_now()})`, reason !== "ended");
      else if (this.holds) this.#show_message("");
    } catch {
      if (performance.now() - this.answered_ms > 1e3 * this.timeout_s && this.holds)
        this.#show_message(`command expired: supercoil monitor has not answered since ${this.answered_at}`);
    } finally {
      this.waiting = false;
    }
  }

  #note_answer() {
    this.answered_ms = performance.now();
    this.answered_at = clock_now();
  }

  #show_message(notice, alarming = true) {
    if (notice === this.notice) return;
    Object.assign(this, { notice, alarming });
    this.dispatchEvent(new Event("notice"));
  }
}
