// A fault's page from docs/faults, beside the plots. It is not modal: STOP stays within reach.

import { element } from "./dom.js";
import { markdown } from "./markdown.js";
import { fault_page } from "./server.js";

export class FaultPage {
  constructor(dialog) {
    this.dialog = dialog;
    this.text = dialog.querySelector("article");
    dialog.querySelector("button").addEventListener("click", () => this.close());
  }

  async open(name) {
    this.before ??= document.activeElement;
    let content;
    try {
      content = markdown(await fault_page(name), (label, target) => this.#link(label, target));
    } catch (problem) {
      content = [element("p", {}, `${name}: ${problem.message}`)];
    }
    this.text.replaceChildren(...content);
    this.text.scrollTop = 0;
    if (!this.dialog.open) this.dialog.show();
    this.dialog.querySelector("button").focus();
  }

  close() {
    this.dialog.close();
    this.before?.focus();
    this.before = null;
  }

  /** Another fault's page opens here; other documents are not served. */
  #link(label, target) {
    const other = /^([a-z_]+)\.md/.exec(target)?.[1];
    if (!other) return element("span", { class: "elsewhere", title: `see ${target.replace(/^\.\.\//, "").replace(/\.md.*/, "")} in supercoil docs` }, label);
    return element("button", { type: "button", class: "link", onclick: () => this.open(other) }, label);
  }
}
