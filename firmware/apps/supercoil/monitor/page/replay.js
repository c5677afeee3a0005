// Plays a log: the time runs by itself, faster or slower, or is moved by hand.

import { show } from "./dom.js";
import { bus_time } from "./format.js";

const TICK_MS = 50;

export class Replay extends EventTarget {
  /** bar: the element with button, slider, select and output. */
  constructor(bar, store) {
    super();
    Object.assign(this, { bar, store, playing: false, time_s: NaN, before_ms: 0 });
    [this.button, this.slider, this.speed, this.output] = ["button", "input", "select", "output"].map((name) => bar.querySelector(name));
    this.button.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("input", () => this.#move_to(this.slider.valueAsNumber));
    store.addEventListener("batch", () => this.#begin());
    bar.hidden = false;
  }

  #begin() {
    Object.assign(this.slider, { min: this.store.oldest_s, max: this.store.newest_s, step: 0.01 });
    if (Number.isNaN(this.time_s)) this.#move_to(this.store.newest_s);
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.time_s >= this.store.newest_s) this.#move_to(this.store.oldest_s);
    show(this.button, this.playing ? "❚❚ pause" : "▶ play");
    this.before_ms = performance.now();
    clearInterval(this.timer);
    if (this.playing) this.timer = setInterval(() => this.#tick(), TICK_MS);
  }

  #tick() {
    const now_ms = performance.now();
    this.#move_to(this.time_s + ((now_ms - this.before_ms) / 1e3) * Number(this.speed.value));
    this.before_ms = now_ms;
    if (this.time_s >= this.store.newest_s) this.toggle();
  }

  #move_to(time_s) {
    this.time_s = Math.min(time_s, this.store.newest_s);
    this.slider.value = this.time_s;
    show(this.output, bus_time(this.time_s));
    this.dispatchEvent(new Event("change"));
  }
}
