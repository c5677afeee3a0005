// Estimates the remaining time from the progress so far.

import { duration } from "./format.js";

// Until this much has been seen, the remaining time is unknown.
const ENOUGH_S = 2;
const ENOUGH_DONE = 0.03;

export class TimeLeft {
  #seen = null;

  /** what: the job; a new one starts a new estimate. done: 0 to 1. ", 14 s left", or nothing while it is unknown. */
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
