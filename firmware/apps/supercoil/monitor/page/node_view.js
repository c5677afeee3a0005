// The view of one node.

import { ControlPanel } from "./control_panel.js";
import { element } from "./dom.js";
import { Gains } from "./gains.js";
import { Identified } from "./identified.js";
import { ManualControl } from "./manual_control.js";
import { joint_of, leader_of, measure_of } from "./joint.js";
import { JointCard } from "./joint_card.js";
import { Journal } from "./journal.js";
import { Margins } from "./margins.js";
import { OutcomeCard } from "./outcome_card.js";
import { Parameters } from "./parameters.js";
import { Plot } from "./plot.js";
import { chosen_plots } from "./plot_choice.js";
import { Readouts } from "./readouts.js";
import { StateCard } from "./state_card.js";
import { Tuning } from "./tuning.js";
import { WaveformCard } from "./waveform_card.js";

// The plots that have room beside other nodes.
const COMPACT_PLOTS = new Set(["Position", "Power", "Temperature"]);

export class NodeView {
  /** run: an OtherRun. may: {command, why}; on_fault: opens the page of a fault. */
  constructor(node, store, view, run, about, may, on_fault) {
    Object.assign(this, { node, view, store, run, protocol: about.protocol });
    this.manual = new ManualControl(node, about.page_timeout_s);
    this.journal = new Journal(node, store);
    this.state = new StateCard(node, store, on_fault, about.protocol_version, (place) => this.tuning.kind_of(place));
    this.panel = new ControlPanel(this.manual, may, (text, kind) => this.journal.add(text, kind));
    this.waveform = new WaveformCard(this.manual, may, (text, kind) => this.journal.add(text, kind),
      () => store.at(node, "Measurement", store.newest_s)?.position_m);
    this.panel.element.hidden = this.waveform.element.hidden = about.kind === "log";
    this.tuning = new Tuning(node, may, (text, kind) => this.journal.add(text, kind));
    this.tuning.element.hidden = about.kind === "log";
    this.margins = new Margins(node, store, on_fault);
    this.cards = [new Readouts(node, store), new Parameters(node, store), new Identified(node, store, about.kind !== "log"), new Gains(node, store), this.margins, new OutcomeCard(node, store, view, about.infeasible), new JointCard(node, store)];
    this.plots = [];
    this.place_of_plots = element("div", { class: "plots" });
    this.lay_out_plots();
    const [readouts, parameters, identified, gains, margins, outcome, joint] = this.cards.map((card) => card.element);
    this.element = element("div", { class: "node", id: `node-${node}`, role: "tabpanel", "aria-label": `node ${node}` },
      element("div", { class: "side" }, this.state.element, joint, this.panel.element, this.waveform.element, outcome, this.journal.element),
      element("div", { class: "main" }, readouts, this.place_of_plots,
        element("div", { class: "lower" }, element("div", { class: "stack" }, parameters, identified, gains, this.tuning.element), margins)));
  }

  /** Lays out the plots that are chosen now. */
  lay_out_plots() {
    for (const plot of this.plots) plot.end();
    this.plots = chosen_plots(this.protocol).map((spec) => new Plot(spec, this.node, this.store, this.view,
      { limits: this.margins.limits, events: this.journal.events, run: this.run }));
    for (const plot of this.plots) plot.element.classList.toggle("full-only", !COMPACT_PLOTS.has(plot.spec.title));
    this.place_of_plots.replaceChildren(...this.plots.map((plot) => plot.element));
  }

  /** Sets a mark at the cursor, or at the newest visible time. */
  mark() {
    const pointed = this.plots.map((plot) => plot.pointed_s).find((time_s) => time_s !== null);
    this.journal.mark(pointed ?? this.view.range.to_s);
    this.draw();
  }

  draw() {
    for (const plot of this.plots) plot.draw();
  }

  /** Updates all text. */
  update() {
    const now_s = this.view.now_s();
    const limits = this.margins.limits.size;
    this.status = this.state.update(now_s);
    if (!this.tuning.element.hidden) this.tuning.follow(this.status);
    for (const card of this.cards) card.update(now_s);
    this.element.classList.toggle("stale", !this.status || this.status.state === "silent");
    if (this.margins.limits.size !== limits) this.draw();
    // Known values stay until a restarting board has sent them again.
    const joint = joint_of(this.store, this.node, now_s);
    if (joint) this.joint = { ...this.joint, ...joint };
    this.panel.update(this.status, this.margins.limits, this.joint, leader_of(this.store, this.node, now_s));
    this.waveform.update(this.margins.limits, measure_of(this.joint));
    for (const plot of this.plots) plot.show_values();
  }
}
