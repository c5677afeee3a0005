// Buttons and keys of the page as a whole.

import { show } from "./dom.js";
import { listen_to_keys, listen_to_wheel } from "./keys.js";

const by_id = (id) => document.getElementById(id);

export function connect_tools({ view, replay, export_csv, fault_page, tabs, plots, setup }) {
  const pause = by_id("pause");
  const toggle = () => (replay && view.live ? replay.toggle() : view.toggle());
  pause.addEventListener("click", toggle);
  pause.hidden = replay !== null;
  by_id("csv").addEventListener("click", export_csv);
  const spans = [...document.querySelectorAll("[name=span]")];
  for (const radio of spans) radio.addEventListener("change", () => view.span(Number(radio.value)));
  view.addEventListener("change", () => {
    show(pause, view.live ? "❚❚ pause" : replay ? "▶ follow" : "▶ live");
    pause.hidden = replay && view.live; // the replay has its own button
    for (const radio of spans) radio.checked = Number(radio.value) === view.span_s;
  });
  by_id("choose-plots").addEventListener("click", () => plots.toggle());
  const help = by_id("help");
  const show_help = () => (help.open ? help.close() : help.show());
  by_id("keys").addEventListener("click", show_help);
  help.querySelector("button").addEventListener("click", () => help.close());
  // Side by side there is no panel that would show the command.
  const nudge = (sign) => tabs.visible.length === 1 && !replay && tabs.visible[0].panel.nudge(sign);
  listen_to_keys({
    k: () => nudge(1), j: () => nudge(-1), m: () => tabs.visible.forEach((node) => node.mark()),
    p: toggle, l: () => view.follow(), End: () => view.follow(), c: export_csv, "?": show_help,
    "+": () => view.zoom(0.5), "=": () => view.zoom(0.5), "-": () => view.zoom(2),
    ArrowLeft: () => view.pan(-0.25), ArrowRight: () => view.pan(0.25),
    Escape: () => (help.open ? help.close() : plots.dialog.open ? plots.dialog.close() : setup?.dialog.open ? setup.dialog.close() : fault_page.dialog.open && fault_page.close()),
  });
  listen_to_wheel(by_id("nodes"), view);
}
