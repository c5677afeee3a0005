// Plays a motion by its knots, sent to the board ahead of time, until it ends, is stopped, or the muscle is let go.

import { refusal_words } from "./refusals.js";

const KNOTS_AT_ONCE = 8;
const PERIOD_MS = 150;
const SETTLED_MS = 500;
const ARRIVAL_TIMEOUT_S = 30;
const NEAR_RATIO = 0.01; // of the travel

const sleep = (duration_ms) => new Promise((resolve) => setTimeout(resolve, duration_ms));

/** Fires "progress" (detail: in words) while it plays, and "stop" (detail: why) once it has ended. */
export class TrajectoryPlayer extends EventTarget {
  /** position(): where the muscle is, in m. */
  constructor(manual, position) {
    super();
    Object.assign(this, { manual, position, run: null });
    manual.addEventListener("release", () => this.stop("the muscle was let go"));
    manual.addEventListener("taken", () => this.stop("commanded by hand"));
    document.addEventListener("visibilitychange", () => this.#stop_if_hidden());
  }

  get playing() {
    return this.run !== null;
  }

  /** motion: from trajectory.js. max_m: the channel's travel. */
  async start(motion, max_m) {
    this.stop("another one starts");
    const knots = motion.knots();
    const next = [knots.next().value];
    // room: as reported by the board; taken_s: time of the last knot that it has.
    const run = { motion, knots, next, first_m: next[0].position_m, room: KNOTS_AT_ONCE, taken_s: 0, buffered_s: 0, answered_ms: 0, started: false };
    this.run = run;
    this.#draw(run);
    const why = (await this.#arrive(run, NEAR_RATIO * max_m)) ?? (await this.#play(run));
    if (run !== this.run) return;
    if (run.ended) this.stop(why);
    else this.hold(why);
  }

  /** Ends the motion; any other command makes the board forget its knots. */
  stop(why) {
    if (!this.playing) return;
    this.run = null;
    this.dispatchEvent(new CustomEvent("stop", { detail: why }));
  }

  /** Ends the motion where it is now. */
  hold(why) {
    if (!this.playing) return;
    const { run } = this;
    const since_s = (performance.now() - run.answered_ms) / 1e3;
    const here_m = run.started ? run.motion.at(Math.min(run.taken_s, run.taken_s - run.buffered_s + since_s)) : run.first_m;
    this.stop(why);
    this.manual.follow(here_m);
  }

  /** A hidden page does not play: it is too slow to refill the board's knots. */
  #stop_if_hidden() {
    if (!document.hidden || !this.playing) return;
    this.stop("the page was hidden; the muscle rests");
    this.manual.send("rest");
  }

  #report(text) {
    this.dispatchEvent(new CustomEvent("progress", { detail: text }));
  }

  /** Goes to the first point. Returns why it did not arrive, or null. */
  async #arrive(run, near_m) {
    this.#report("goes to its first point");
    const { obeyed, text } = await this.manual.follow(run.first_m);
    if (!obeyed) return this.#end(run, text);
    const begin_ms = performance.now();
    for (let near_since_ms = Infinity, now_ms = begin_ms; run === this.run && now_ms - near_since_ms < SETTLED_MS; now_ms = performance.now()) {
      if (now_ms - begin_ms > 1e3 * ARRIVAL_TIMEOUT_S) return `did not come within ${(1e3 * near_m).toFixed(2)} mm of its first point in ${ARRIVAL_TIMEOUT_S} s`;
      near_since_ms = Math.abs(this.position() - run.first_m) < near_m ? Math.min(near_since_ms, now_ms) : Infinity;
      await sleep(PERIOD_MS / 3);
    }
    return null;
  }

  /** Ends the run without holding anything afterwards. */
  #end(run, why) {
    run.ended = true;
    return why;
  }

  /** Returns why it ended. */
  async #play(run) {
    while (run === this.run) {
      const batch = run.next.slice(0, Math.min(KNOTS_AT_ONCE, run.room));
      const starts = !run.started && batch.length === 0;
      const after_s = (i) => Math.round(1e3 * (batch[i].time_s - (i > 0 ? batch[i - 1].time_s : run.taken_s))) / 1e3;
      const reply = await this.manual.play(batch.map(({ time_s, ...knot }, i) => ({ after_s: after_s(i), ...knot })), starts);
      if (run !== this.run) return "";
      const why = this.#take(run, reply, starts);
      if (why) return why;
      const behind = batch.length === KNOTS_AT_ONCE && run.room >= KNOTS_AT_ONCE;
      if (run.started && !behind) await sleep(PERIOD_MS);
    }
    return "";
  }

  /** Takes the knots to send next from the motion. */
  #draw(run) {
    while (run.next.length < KNOTS_AT_ONCE) {
      const { done, value } = run.knots.next();
      if (done) return;
      run.next.push(value);
    }
  }

  /** Returns why it cannot go on, or "". */
  #take(run, { problem, refusal, taken, playback, room, buffered_s }, starts) {
    if (problem) return this.#end(run, problem);
    if (taken > 0) run.taken_s = run.next[taken - 1].time_s;
    run.next.splice(0, taken);
    this.#draw(run);
    Object.assign(run, { room, buffered_s: buffered_s ?? 0, answered_ms: performance.now() });
    const all = run.next.length === 0;
    if (run.started && (playback === "dry" || (playback === "ended" && !all))) return this.#end(run, "ran dry: its next knot came too late");
    if (refusal === "infeasible") return `the motion up to ${run.next[0].time_s.toFixed(2)} s is infeasible: it needs more power than there is, or faster cooling`;
    if (run.started && playback === "empty") return this.#end(run, "the board received another command");
    if (refusal !== "none" && refusal !== "queue_full") return `${starts ? "its start" : `the knot at ${(run.next[0]?.time_s ?? run.taken_s).toFixed(2)} s`} was refused: ${refusal_words(refusal)}`;
    if (playback === "ended") return this.#end(run, "played to its end");
    run.started ||= starts;
    this.#report_progress(run);
    return "";
  }

  #report_progress(run) {
    const { end_s } = run.motion;
    if (!run.started) return this.#report("sends the motion ahead");
    const whole = Number.isFinite(end_s) ? ` of ${end_s.toFixed(1)}` : "";
    this.#report(`${(run.taken_s - run.buffered_s).toFixed(1)}${whole} s, ${run.buffered_s.toFixed(1)} s ahead on the board`);
  }
}
