// Setup, step by step: says what each step does before it begins, and keeps its findings visible. The steps run in the
// monitor; this shows their state, asks, and sends the answers.

import { element, show } from "./dom.js";
import { significant, words } from "./format.js";
import { request_setup, setup_state } from "./server.js";
import { TimeLeft } from "./time_left.js";

const POLL_PERIOD_MS = 400;

const text_of = (value) => (value === null ? "–" : typeof value === "number" ? significant(value) : String(value));

export class Setup {
  /** opener: the button that opens it. store: while the bus sends data, a hidden page is not put to sleep. */
  constructor(dialog, opener, store) {
    Object.assign(this, { dialog, state: null, shown: "", polled_ms: 0, requests: 0, refusal: null, time_left: new TimeLeft() });
    const [close, undo] = dialog.querySelectorAll(":scope > button");
    const [what, answer] = dialog.querySelectorAll(":scope > p");
    Object.assign(this, { undo, what, answer, list: dialog.querySelector("ol") });
    opener.hidden = false;
    opener.addEventListener("click", () => (dialog.open ? dialog.close() : this.open()));
    close.addEventListener("click", () => dialog.close());
    undo.addEventListener("click", () => this.#request({ do: "undo" }));
    const poll_if_active = () => (dialog.open || this.state?.running) && this.poll();
    setInterval(poll_if_active, POLL_PERIOD_MS);
    store.addEventListener("batch", poll_if_active);
  }

  open() {
    this.dialog.show();
    this.poll();
  }

  async poll() {
    if (performance.now() - this.polled_ms < POLL_PERIOD_MS) return;
    this.polled_ms = performance.now();
    const { requests } = this;
    try {
      const state = await setup_state();
      // Ignores a state that was read before the latest request.
      if (requests === this.requests) this.#take(state);
    } catch (problem) {
      this.#show_message(problem.message, true);
    }
  }

  async #request(order) {
    this.requests++;
    try {
      const { done, ...state } = await request_setup(order);
      this.refusal = null;
      this.#take(state);
      this.#show_message(done);
    } catch (problem) {
      const { question } = this.state;
      if (order.do === "answer" && question) return this.#refuse_answer(question.key, problem.message);
      this.#show_message(problem.message, true);
      this.answer.scrollIntoView({ block: "nearest" });
    }
  }

  /** Shown where the user looks: at the question. */
  #refuse_answer(key, text) {
    this.refusal = { key, text };
    this.#draw();
    this.#draw_progress();
  }

  #show_message(text, refused = false) {
    show(this.answer, text);
    this.answer.classList.toggle("refused", refused);
  }

  #take(state) {
    this.state = state;
    // Everything but the progress is only redrawn when it changed: the user may be typing.
    const shown = JSON.stringify({ ...state, progress: null });
    if (shown !== this.shown) this.#draw();
    this.shown = shown;
    this.#draw_progress();
  }

  #draw() {
    const { file, channel, steps, running, last } = this.state;
    this.what.title = file;
    show(this.what, `Channel ${channel} of ${file.split("/").pop()}. STOP ends a step at once; so does closing this page.`);
    this.undo.disabled = running !== null;
    const done = steps.findLastIndex(({ found }) => found !== null);
    const next = steps.findIndex(({ optional }, place) => place > done && !optional);
    const before = this.list.querySelector("form input");
    this.list.replaceChildren(...steps.map((step, place) => {
      const runs = step.name === running;
      return element("li", { class: runs ? "runs" : place === next ? "next" : "", "aria-current": runs ? "step" : null },
        element("h3", {}, step.name, step.optional ? " (optional)" : ""), element("p", {}, step.does),
        this.#found(step),
        ...(step.name === last ? this.#step_details(runs) : []),
        runs ? element("button", { type: "button", onclick: () => this.#request({ do: "end" }) }, `end ${step.name}`)
          : element("button", { type: "button", disabled: running !== null, onclick: () => this.#request({ do: "begin", step: step.name }) },
            step.found === null ? `begin ${step.name}` : `${step.name} again`));
    }));
    const input = this.list.querySelector("form input");
    // Lines may arrive while the user types.
    if (input && input.id === before?.id) input.value = before.value;
    input?.focus();
    this.list.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest" });
  }

  /** A table of a step's findings. */
  #found({ name, found }) {
    if (found === null) return "";
    return element("details", {}, element("summary", {}, "done; what it found"),
      element("table", { "aria-label": `found by ${name}` }, ...Object.entries(found).filter(([, value]) => typeof value !== "object" || value === null).map(([key, value]) =>
        element("tr", {}, element("th", { scope: "row", title: key }, words(key)), element("td", {}, text_of(value))))));
  }

  #step_details(runs) {
    const { lines, question, error, kept, steps, last } = this.state;
    const found = steps.find(({ name }) => name === last)?.found;
    const items = lines.map((line) => element("li", {}, line));
    const parts = [element("div", { class: "lines", role: "log", "aria-label": "messages of setup", tabindex: 0 }, element("ul", {}, ...items))];
    if (runs) {
      this.progress = element("progress", { max: 1, "aria-label": "progress of the step" });
      this.progress_text = element("span");
      parts.push(element("p", { class: "progress" }, this.progress, this.progress_text));
    }
    if (question) parts.push(this.#question(question));
    if (error) parts.push(element("p", { class: "answer refused", role: "alert" }, error));
    else if (!runs && !kept) parts.push(element("p", { class: "answer refused", role: "alert" }, "The promise was not kept."));
    // Names with dots are keys of the board's file.
    else if (!runs && Object.keys(found ?? {}).some((key) => key.includes("."))) parts.push(element("p", { class: "answer" }, "The file was changed: start the board with it, then go on with the next step."));
    return parts;
  }

  #question({ key, text, range, fallback }) {
    const input = element("input", { type: "text", inputmode: "decimal", id: `setup-${key}`, placeholder: fallback ?? "", autocomplete: "off" });
    const refused = this.refusal?.key === key;
    if (refused) {
      input.setAttribute("aria-invalid", "true");
      input.setAttribute("aria-describedby", "setup-refusal");
    }
    return element("form", { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#request({ do: "answer", text: input.value.trim() }); } },
      element("label", { for: input.id }, text), element("p", { class: "hint" }, `${range}${fallback === null ? "" : `; empty means ${fallback}`}`),
      input, " ", element("button", { type: "submit" }, "next"),
      refused ? element("p", { class: "answer refused", role: "alert", id: "setup-refusal" }, this.refusal.text) : "");
  }

  #draw_progress() {
    const { running, progress, question } = this.state;
    if (!running || progress?.done == null) this.time_left.forget();
    if (!running || !this.progress) return;
    this.progress.parentElement.hidden = question !== null;
    if (progress?.done == null) this.progress.removeAttribute("value");
    else this.progress.value = progress.done;
    show(this.progress_text, progress ? ` ${words(progress.what)}${progress.done == null ? "" : this.#done_text(progress)}` : "");
  }

  #done_text({ what, done }) {
    return `, ${Math.round(100 * done)} %${this.time_left.text(what, performance.now() / 1000, done)}`;
  }
}
