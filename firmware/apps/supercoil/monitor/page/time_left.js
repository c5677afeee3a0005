// How long something still takes, by how fast it went so far.

import { duration } from "./format.js";

// Before this has been seen of it, nobody knows how long the rest takes.
const ENOUGH_S = 2;
const ENOUGH_DONE = 0.03;

export class TimeLeft {
  #seen = null;

  /** what: another one begins anew. done: 0 to 1. ", 14 s left", or nothing while it cannot be told. */
  text(what, time_s, done) {
    if (this.#seen?.what !== what || done < this.#seen.done) this.#seen = { what, time_s, done };
    const passed_s = time_s - this.#seen.time_s;
    const since = done - this.#seen.done;
    return passed_s < ENOUGH_S || since < ENOUGH_DONE ? "" : `, ${duration(Math.round(passed_s * (1 - done) / since))} left`;
  }

  forget() {
    this.#seen = null;
  }
}
