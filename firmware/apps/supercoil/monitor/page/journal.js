// What happened, newest first: commands and answers, changes of state, faults, losses.

import { element } from "./dom.js";
import { bus_time, words } from "./format.js";

const KEPT = 200;

export class Journal {
  constructor(node, store) {
    Object.assign(this, { node, store, last: {}, events: [], marks: 0 });
    this.list = element("ol");
    this.element = element("section", { class: "card full-only happened" }, element("h2", {}, "What happened"),
      element("div", { class: "journal", role: "log", "aria-label": `what happened at node ${node}`, tabindex: 0 }, this.list));
  }

  add(text, kind = "", time_s = this.store.newest_s) {
    this.list.prepend(element("li", { class: kind }, element("time", {}, bus_time(time_s)), ` ${text}`));
    this.events.push({ time_s, text, kind });
    if (this.events.length > KEPT) this.events.shift();
    while (this.list.children.length > KEPT) this.list.lastChild.remove();
  }

  /** A mark set by the user. */
  mark(time_s) {
    this.add(`mark ${++this.marks}`, "", time_s);
  }

  /** Journals changes of state, mode and fault in a new batch. */
  read(rows) {
    const status = rows?.Status;
    for (let i = 0; i < (status?.time_s.length ?? 0); ++i) {
      for (const signal of ["state", "mode", "fault"]) {
        const value = status[signal][i];
        const before = this.last[signal];
        this.last[signal] = value;
        if (before === undefined || before === value) continue;
        const name = words(this.store.word("Status", signal, value));
        this.add(`${signal}: ${name}`, signal === "fault" && value !== 0 ? "warn" : "", status.time_s[i]);
      }
    }
  }
}
