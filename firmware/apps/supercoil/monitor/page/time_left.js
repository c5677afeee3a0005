// Estimates the remaining time from the progress so far.

import { duration } from "./format.js";

// Until this much has been seen, the remaining time is unknown.
const MIN_ELAPSED_S = 2;
const MIN_DONE = 0.03;

export class TimeLeft {
  #start = null;

  /** what: the job; a new one starts a new estimate. done: 0 to 1. ", 14 s left", or nothing while it is unknown. */
  text(what, time_s, done) {
    if (this.#start?.what !== what || done < this.#start.done) this.#start = { what, time_s, done };
    const passed_s = time_s - this.#start.time_s;
    const since = done - this.#start.done;
    return passed_s < MIN_ELAPSED_S || since < MIN_DONE ? "" : `, ${duration(Math.round(passed_s * (1 - done) / since))} left`;
  }

  forget() {
    this.#start = null;
  }
}
