// Fills the store: the newest minute first, so that the first plot appears at once, then the stream, then older minutes.

import { history_of } from "./server.js";

const INITIAL_SPAN_S = 60;
const FETCH_SPAN_S = 30;

export class Feed {
  #waiting = null; // batches of the stream while history is being fetched; null: no fetch is under way
  #filling = Promise.resolve();
  #older = 0;

  /** on_problem: called with the error of a failed request for history. */
  constructor(store, stream, is_log, on_problem) {
    this.store = store;
    this.is_log = is_log;
    this.on_problem = on_problem;
    stream.addEventListener("batch", ({ detail }) => {
      if (this.#waiting) this.#waiting.push(detail);
      else store.append(detail);
    });
    // The stream was opened, perhaps again: earlier data is in the history.
    stream.addEventListener("open", () => this.fill());
    store.addEventListener("restart", () => ++this.#older);
  }

  /** Fetches what is missing up to now. */
  fill() {
    this.#filling = this.#filling.then(() => this.#fill());
  }

  async #fill() {
    const known = !this.store.empty;
    if (known && this.is_log) return;
    this.#waiting ??= [];
    try {
      this.store.append(await history_of(...this.#missing(known)));
    } catch (problem) {
      this.on_problem(problem.message);
    } finally {
      const waiting = this.#waiting;
      this.#waiting = null;
      // Batches from before the request are in the history; appended again they would look like a source that restarts.
      for (const batch of waiting ?? []) if (!(batch.newest_s <= this.store.newest_s)) this.store.append(batch);
    }
    if (!known && !this.is_log) this.#fetch_older(++this.#older).catch((problem) => this.on_problem(problem.message));
  }

  #missing(known) {
    if (this.is_log) return [];
    return known ? [this.store.newest_s] : [-INITIAL_SPAN_S];
  }

  async #fetch_older(turn) {
    const { store } = this;
    const end_s = store.newest_s - store.keep_s;
    while (turn === this.#older && store.oldest_s > end_s) {
      const older = await history_of(store.oldest_s - FETCH_SPAN_S, store.oldest_s);
      if (turn !== this.#older || !store.prepend(older)) return;
    }
  }
}
