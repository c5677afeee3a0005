// Tabs of the nodes, and one that shows all side by side.

import { element, show } from "./dom.js";

const ALL = "all";

export class NodeTabs {
  /** place: the tab list; stage: where the nodes' views are. */
  constructor(place, stage) {
    Object.assign(this, { place, stage, views: new Map(), tabs: new Map(), chosen: null });
    place.addEventListener("keydown", (event) => this.#key(event));
  }

  add(view) {
    this.views.set(view.node, view);
    const nodes = [...this.views.keys()].sort((a, b) => a - b);
    this.stage.append(...nodes.map((node) => this.views.get(node).element));
    this.#tab(view.node, `node ${view.node}`);
    if (nodes.length > 1 && !this.tabs.has(ALL)) this.#tab(ALL, "side by side");
    this.place.append(...[...nodes, ALL].filter((name) => this.tabs.has(name)).map((name) => this.tabs.get(name)));
    this.choose(this.chosen ?? nodes[0]);
  }

  #tab(name, text) {
    const tab = element("button", { type: "button", role: "tab", "aria-controls": name === ALL ? this.stage.id : `node-${name}`,
      onclick: () => this.choose(name) }, `${text} `, element("span", { class: "word" }));
    this.tabs.set(name, tab);
  }

  choose(name) {
    this.chosen = name;
    this.stage.classList.toggle("compact", name === ALL);
    for (const [node, view] of this.views) view.element.hidden = name !== ALL && name !== node;
    for (const [tab_name, tab] of this.tabs) {
      tab.setAttribute("aria-selected", tab_name === name);
      tab.tabIndex = tab_name === name ? 0 : -1;
    }
  }

  #key(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const names = [...this.place.children];
    const next = names[(names.indexOf(document.activeElement) + step + names.length) % names.length];
    next.focus();
    next.click();
    event.preventDefault();
  }

  /** The views that are on the screen. */
  get visible() {
    return [...this.views.values()].filter((view) => !view.element.hidden);
  }

  /** Shows the states of hidden nodes on their tabs. */
  update() {
    for (const [node, view] of this.views) {
      const tab = this.tabs.get(node);
      tab.dataset.state = view.status?.state ?? "silent";
      show(tab.lastChild, tab.dataset.state);
    }
  }
}
