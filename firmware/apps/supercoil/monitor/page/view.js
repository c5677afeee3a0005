// The time shown: the newest (live), or a fixed part of the past (paused).

const MIN_SPAN_S = 0.5;

export class View extends EventTarget {
  /** now_s: a function that returns the newest time available; oldest_s: likewise. */
  constructor(now_s, oldest_s) {
    super();
    this.now_s = now_s;
    this.oldest_s = oldest_s;
    this.span_s = 60;
    this.end_s = null; // null: live
  }

  get live() {
    return this.end_s === null;
  }

  get range() {
    const to_s = this.end_s ?? this.now_s();
    return { from_s: to_s - this.span_s, to_s };
  }

  follow() {
    this.#set(this.span_s, null);
  }

  pause() {
    this.#set(this.span_s, this.range.to_s);
  }

  toggle() {
    if (this.live) this.pause();
    else this.follow();
  }

  /** Live stays live. */
  span(span_s) {
    this.#set(span_s, this.end_s);
  }

  show(from_s, to_s) {
    this.#set(to_s - from_s, to_s);
  }

  /** factor below 1: zooms in. about: what stays in place, 0 to 1 from left to right; live stays live. */
  zoom(factor, about = 1) {
    const { from_s, to_s } = this.range;
    const span_s = this.span_s * factor;
    this.#set(span_s, this.live ? null : from_s + about * (to_s - from_s) + (1 - about) * span_s);
  }

  /** part of the span; negative: towards the past. */
  pan(part) {
    const end_s = this.range.to_s + part * this.span_s;
    this.#set(this.span_s, end_s >= this.now_s() ? null : Math.max(end_s, this.oldest_s()));
  }

  #set(span_s, end_s) {
    this.span_s = Math.max(MIN_SPAN_S, span_s);
    this.end_s = end_s;
    this.dispatchEvent(new Event("change"));
  }
}
