// Plays a waveform to a muscle, one set point after the other, until it ends, is stopped, or the muscle is let go.

import { fixed } from "./format.js";

const PERIOD_MS = 50;

/** Fires "progress" (detail: in words) while it plays, and "stop" (detail: why) once it has ended. */
export class WavePlayer extends EventTarget {
  constructor(manual) {
    super();
    Object.assign(this, { manual, wave: null, time_s: 0, waiting: false });
    // STOP, a fault, another mode: anything that lets go of the muscle ends the waveform at once.
    manual.addEventListener("release", () => this.stop("the muscle was let go"));
    manual.addEventListener("taken", () => this.stop("commanded by hand"));
  }

  get playing() {
    return this.wave !== null;
  }

  /** wave: {at, end_s} from waveform.js. */
  start(wave) {
    this.stop("another one starts");
    Object.assign(this, { wave, time_s: 0, begin_ms: performance.now() });
    this.timer = setInterval(() => this.#tick(), PERIOD_MS);
    this.#tick();
  }

  hold(why) {
    this.stop(why);
  }

  /** The muscle stays at its last set point. */
  stop(why) {
    if (!this.playing) return;
    clearInterval(this.timer);
    this.wave = null;
    this.dispatchEvent(new CustomEvent("stop", { detail: why }));
  }

  /** A set point waits for the previous answer: a slow line gets fewer set points, not late ones. */
  async #tick() {
    if (this.waiting) return;
    const { wave } = this;
    this.time_s = Math.min((performance.now() - this.begin_ms) / 1e3, wave.end_s);
    const ends = this.time_s >= wave.end_s;
    this.waiting = true;
    const { obeyed, text } = await this.manual.follow(wave.at(this.time_s));
    this.waiting = false;
    if (wave !== this.wave) return;
    if (!obeyed) return this.stop(text);
    this.dispatchEvent(new CustomEvent("progress", { detail: `${fixed(this.time_s, 1)} s` }));
    if (ends) this.stop("played to its end");
  }
}
