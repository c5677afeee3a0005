// Assembles the page: server → stream → store → views.

import { csv, download } from "./csv.js";
import { show } from "./dom.js";
import { FaultPage } from "./fault_page.js";
import { Feed } from "./feed.js";
import { NodeTabs } from "./node_tabs.js";
import { NodeView } from "./node_view.js";
import { OtherRun } from "./other_run.js";
import { PlotDialog } from "./plot_dialog.js";
import { take_refusals } from "./refusals.js";
import { take_results } from "./results.js";
import { Replay } from "./replay.js";
import { RunBar } from "./run_bar.js";
import { Setup } from "./setup.js";
import { about as fetch_about, token } from "./server.js";
import { StatusLine } from "./status_line.js";
import { Stop } from "./stop.js";
import { Store } from "./store.js";
import { Stream } from "./stream.js";
import { connect_tools } from "./tools.js";
import { View } from "./view.js";

const TEXT_PERIOD_MS = 100;
const reduced_motion = matchMedia("(prefers-reduced-motion: reduce)");
const draw_period_ms = () => (reduced_motion.matches ? 500 : 33);

const by_id = (id) => document.getElementById(id);

function may_command(about) {
  if (about.read_only) return { command: false, why: "For viewing only: the monitor was started with --read-only." };
  if (!token) return { command: false, why: "For viewing only: no token. Open the address that supercoil monitor printed at its start." };
  if (!about.may_command) return { command: false, why: "For viewing only: the token is not this monitor's. Open the address that it printed at its start." };
  return { command: true, why: "" };
}

function begin(about) {
  take_refusals(about.refusals);
  take_results(about.results, about.notes);
  const is_log = about.kind === "log";
  show(by_id("source"), about.source);
  by_id("source").title = `supercoil ${about.version}`;
  const store = new Store(about.protocol, is_log);
  const stream = new Stream();
  const replay = is_log ? new Replay(by_id("replay"), store) : null;
  const view = new View(() => replay?.time_s ?? store.newest_s, () => store.oldest_s);
  const fault_page = new FaultPage(by_id("fault-page"));
  const tabs = new NodeTabs(by_id("tabs"), by_id("nodes"));
  const status = new StatusLine(by_id("status"), stream, store, view, is_log);
  const show_problem = (text) => {
    by_id("problem").hidden = false;
    show(by_id("problem"), text);
  };
  const feed = new Feed(store, stream, is_log, show_problem);

  const run = new OtherRun(about.protocol);
  new RunBar(by_id("run"), run, store, view, () => tabs.visible.map(({ node }) => node));
  const plots = new PlotDialog(by_id("plots"), about.protocol, () => views().forEach((node) => node.lay_out_plots()));
  const add = (node) => tabs.add(new NodeView(node, store, view, run, about, may_command(about), (name) => fault_page.open(name)));
  const views = () => [...tabs.views.values()];
  store.addEventListener("node", ({ detail }) => add(detail));
  store.addEventListener("restart", () => views().forEach((node) => node.journal.add("the source restarted")));
  store.addEventListener("batch", ({ detail }) => {
    for (const node of views()) node.journal.read(detail.nodes?.[node.node]);
  });
  const stop = new Stop(by_id("stop"), by_id("stop-notice"), about, () => [...tabs.views.keys()], () => store.newest_s, () =>
    views().forEach(({ manual, journal }) => {
      manual.release_hold();
      journal.add("STOP");
    }));

  const export_csv = async () => {
    const nodes = tabs.visible.map(({ node }) => node);
    const { from_s, to_s } = view.range;
    download(await csv(store, nodes, view.range), `supercoil-node-${nodes.join("-")}-${from_s.toFixed(0)}-to-${to_s.toFixed(0)}-s.csv`);
  };
  // A log is first shown as a whole.
  if (is_log) store.addEventListener("batch", () => view.span(Math.max(1, store.newest_s - store.oldest_s)), { once: true });
  const setup = about.setup ? new Setup(by_id("setup"), by_id("open-setup"), store) : null;
  connect_tools({ view, replay, export_csv, fault_page, tabs, plots, setup });
  draw_forever({ store, view, replay, run, tabs, status, stop });
  stream.open();
  feed.fill();
}

/** Redraws plots when there is new data, texts ten times a second. */
function draw_forever({ store, view, replay, run, tabs, status, stop }) {
  let stale = true; // new data came
  let draw_requested = true; // the user waits for it
  let plots_ms = 0;
  let texts_ms = 0;
  const request_draw = () => (draw_requested = true);
  store.addEventListener("batch", () => (stale = true));
  view.addEventListener("change", request_draw);
  replay?.addEventListener("change", request_draw);
  run.addEventListener("change", request_draw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", request_draw);
  const frame = (now_ms) => {
    requestAnimationFrame(frame);
    // Skip drawing an hour that scrolls by less than a pixel.
    const enough_ms = Math.max(draw_period_ms(), Math.min(1000, view.span_s));
    if (!store.empty && (draw_requested || (stale && view.live && now_ms - plots_ms >= enough_ms))) {
      draw_requested = stale = false;
      plots_ms = now_ms;
      for (const node of tabs.visible) node.draw();
    }
    if (now_ms - texts_ms >= TEXT_PERIOD_MS) {
      texts_ms = now_ms;
      status.update();
      for (const node of tabs.views.values()) node.update();
      tabs.update();
      stop.observe([...tabs.views.values()].map((node) => node.status));
    }
  };
  requestAnimationFrame(frame);
}

fetch_about().then(begin, (problem) => {
  const status = by_id("status");
  status.dataset.kind = "lost";
  show(status.querySelector("b"), "no access");
  show(status.querySelector("span"), `${problem.message}${token ? "" : " – open the address that supercoil monitor printed at its start, with its token"}`);
});
