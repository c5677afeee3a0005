// STOP: disarms every muscle. By the button, or by the space bar, wherever the focus is.

import { show } from "./dom.js";
import { clock_now } from "./format.js";
import { disarm_within, stop } from "./server.js";

// For the fallback. A board that is present answers within half a second.
const DISARM_WITHIN_MS = 1500;

const OFF = new Set(["disarmed", "fault"]);

export class Stop {
  /** nodes, newest_s: functions that return the known nodes and the newest time received; release_hold: ends everything that this page keeps hot, without a request. */
  constructor(button, notice, about, nodes, newest_s, release_hold) {
    Object.assign(this, { button, notice, port: about.stop_port, nodes, newest_s, release_hold });
    button.hidden = about.kind === "log";
    button.disabled = about.read_only;
    if (button.disabled) button.title = "this monitor is read-only: use the board's stop button";
    if (button.hidden || button.disabled) return;
    button.addEventListener("click", () => this.press());
    // In the capture phase, before anything else sees the key: a focused button or input does not get it.
    addEventListener("keydown", (event) => this.#key(event, () => event.repeat || this.press()), { capture: true });
    addEventListener("keyup", (event) => this.#key(event, () => {}), { capture: true });
    addEventListener("keypress", (event) => this.#key(event, () => {}), { capture: true });
  }

  #key(event, act) {
    if (event.code !== "Space" && event.key !== " ") return;
    event.preventDefault();
    event.stopImmediatePropagation();
    act();
  }

  /** statuses: of all nodes, as StateCard returns them, null for silent nodes. Their newer state replaces a failed STOP. */
  observe(statuses) {
    if (this.notice.dataset.kind !== "failed" || this.notice.hidden || statuses.length === 0) return;
    if (!statuses.every((status) => status && OFF.has(status.state) && status.time_s > this.pressed_s)) return;
    this.#show_message(`every node reports its muscle off (${clock_now()}); STOP itself failed: ${this.problem}`, "done");
  }

  async press() {
    // First, because it needs no answer: a command that is no longer renewed expires on the board by itself.
    this.release_hold();
    this.pressed_s = this.newest_s();
    this.button.classList.add("pressed");
    try {
      const nodes = await stop(this.port);
      this.#show_message(nodes.length ? `stopped node ${nodes.join(", ")} (${clock_now()})` : "stopped; no node was ever heard", "done");
    } catch (problem) {
      await this.#by_commands(problem);
    } finally {
      this.button.classList.remove("pressed");
    }
  }

  /** The fallback, when the STOP port does not answer. */
  async #by_commands(problem) {
    this.problem = problem.message;
    this.#show_message(`STOP did not get through (${problem.message}); disarming each node …`, "failed");
    const answers = await Promise.allSettled(this.nodes().map((node) => disarm_within(DISARM_WITHIN_MS, node)));
    const obeyed = answers.length > 0 && answers.every(({ value }) => value === "none");
    if (obeyed) {
      this.#show_message(`disarmed each node by a command; STOP itself failed: ${problem.message}`, "done");
    } else {
      this.#show_message(`STOP FAILED: ${problem.message}. Use the stop button of the board.`, "failed");
    }
  }

  #show_message(text, kind) {
    show(this.notice, text);
    this.notice.dataset.kind = kind;
    this.notice.hidden = false;
    clearTimeout(this.hiding);
    if (kind === "done") this.hiding = setTimeout(() => (this.notice.hidden = true), 6000);
  }
}
