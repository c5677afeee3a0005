// One plot: some columns of a node over time, its limits as lines, its newest values as text.

import { download } from "./csv.js";
import { bucket_times } from "./decimate.js";
import { colour, element, show } from "./dom.js";
import { AGES, bus_time, fixed, is_old, measured_ago } from "./format.js";
import { picture_of } from "./picture.js";
import { axes, round_span } from "./plot_axes.js";
import { draw_events, draw_limit, draw_pale, draw_strip } from "./plot_marks.js";
import { points_of } from "./plot_points.js";

const HEIGHT_PX = 176;
/** Lets tests measure how soon the first plot appears. */
function mark_first_plot() {
  if (performance.getEntriesByName("first-plot").length === 0) performance.mark("first-plot");
}

export class Plot {
  /**
   * spec: {title, unit, factor, decimals, min_span, from_zero, lines: [{message, column, name, colour, dash, fill}],
   * band: [upper, lower] places in lines, mark: {message, column}: drawn as a strip while it is 1,
   * limit: fault whose limit is drawn}; what is shown is the column times factor. limits: of the detectors, by fault.
   * events: of the node, {time_s, text, kind}, in the order in which they happened. run: an OtherRun.
   */
  constructor(spec, node, store, view, { limits, events, run }) {
    Object.assign(this, { spec, node, store, view, limits, events, run, pale: [], seen: false, hover: null });
    this.legend = spec.lines.map(() => element("b", {}, "–"));
    this.when = element("span", { class: "when" });
    this.hole = element("div", { class: "canvas" });
    this.element = element("figure", { class: "plot", "aria-label": `${spec.title}, node ${node}` },
      element("figcaption", {}, element("h3", {}, `${spec.title} `, element("span", { class: "unit" }, spec.unit), this.when),
        element("button", { type: "button", class: "link", "aria-label": `PNG of ${spec.title}`, title: "save as a picture", onclick: () => this.#picture() }, "PNG"),
        element("ul", { class: "legend" }, ...this.#legend())),
      this.hole);
    this.observers = [new ResizeObserver(() => this.#resize()), new IntersectionObserver(([entry]) => this.#show_or_hide(entry.isIntersecting))];
    this.observers[0].observe(this.hole);
    this.observers[1].observe(this.element);
  }

  #legend() {
    return this.spec.lines.map((line, i) =>
      element("li", { style: `--line: var(--${line.colour})`, class: line.dash ? "dashed" : "" },
        `${line.name} `, this.legend[i]));
  }

  /** Call it when the plot is no longer needed. */
  end() {
    for (const observer of this.observers) observer.disconnect();
    this.chart?.destroy();
  }

  /** The time under the cursor, or null. */
  get pointed_s() {
    return this.hover != null && this.chart ? this.chart.data[0][this.hover] : null;
  }

  async #picture() {
    const { spec } = this;
    const title = `${spec.title} in ${spec.unit}, node ${this.node}`;
    download(await picture_of(this.chart, title, spec.lines), `supercoil-node-${this.node}-${spec.title.toLowerCase().replaceAll(" ", "-")}.png`);
  }

  /** A plot out of sight is not drawn. */
  #show_or_hide(seen) {
    this.seen = seen;
    this.draw();
  }

  #resize() {
    const width = this.hole.clientWidth;
    if (width === 0) return;
    if (this.chart) this.chart.setSize({ width, height: HEIGHT_PX });
    else this.chart = new uPlot(this.#options(width), [[], ...this.spec.lines.map(() => [])], this.hole);
    this.draw();
  }

  #options(width) {
    const { spec } = this;
    return {
      width, height: HEIGHT_PX, pxAlign: 1, legend: { show: false }, padding: [16, 18, 0, 0],
      cursor: { sync: { key: "time" }, y: false, points: { size: 6 }, drag: { x: true, y: false, setScale: false },
        bind: { dblclick: () => () => this.view.follow() } },
      scales: { x: { time: false }, y: { range: (_, min, max) => this.#span(min, max) } },
      axes: axes(),
      series: [{}, ...spec.lines.map((line) => ({
        stroke: () => colour(line.colour), width: line.width ?? 1.5, dash: line.dash, points: { show: false },
        fill: line.fill ? () => `${colour(line.colour)}22` : undefined }))],
      bands: spec.band ? [{ series: spec.band.map((line) => line + 1), fill: () => `${colour("band")}` }] : [],
      hooks: { drawAxes: [() => this.#draw_run()], draw: [() => this.#draw_limits()], setCursor: [(chart) => (this.hover = chart.cursor.idx)],
        setSelect: [(chart) => this.#selected(chart)] },
    };
  }

  #span(min, max) {
    const others = this.pale.flat().filter(Number.isFinite);
    let low = Math.min(min ?? 0, ...others);
    let high = Math.max(max ?? 0, ...others);
    return round_span(low, high, this.spec, this.#limit);
  }

  get #limit() {
    const limit = this.limits.get(this.spec.limit);
    return Number.isFinite(limit) ? limit * this.spec.factor : null;
  }

  #selected(chart) {
    const { left, width } = chart.select;
    if (width < 6) return;
    this.view.show(chart.posToVal(left, "x"), chart.posToVal(left + width, "x"));
    chart.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
  }

  #draw_run() {
    this.pale.forEach((points, i) => draw_pale(this.chart, this.chart.data[0], points, colour(this.spec.lines[i].colour)));
  }

  draw() {
    const range = this.view.range;
    if (!this.chart || !this.seen || Number.isNaN(range.to_s)) return;
    const { spec } = this;
    const buckets = Math.max(50, Math.floor(this.chart.bbox.width / devicePixelRatio));
    const table_of = (message) => this.store.table(this.node, message);
    const lines = points_of(spec.lines, spec.factor, table_of, range, buckets);
    const { later_s } = this.run;
    this.pale = this.run.store ? points_of(spec.lines, spec.factor, (message) => this.run.table(this.node, message),
      { from_s: range.from_s - later_s, to_s: range.to_s - later_s }, buckets) : [];
    this.marked = spec.mark && points_of([spec.mark], 1, table_of, range, buckets)[0];
    this.chart.batch(() => {
      this.chart.setData([bucket_times(range.from_s, range.to_s, buckets), ...lines], false);
      this.chart.setScale("x", { min: range.from_s, max: range.to_s });
    });
    mark_first_plot();
  }

  #draw_limits() {
    const { ctx } = this.chart;
    ctx.save();
    if (this.marked) draw_strip(this.chart, this.marked);
    if (this.#limit !== null) draw_limit(this.chart, this.#limit, this.spec.unit);
    ctx.restore();
    const { from_s, to_s } = this.view.range;
    draw_events(this.chart, this.events.filter(({ time_s }) => time_s >= from_s && time_s <= to_s));
  }

  /** Shows the values under the cursor, or the newest visible ones. */
  show_values() {
    const { spec } = this;
    const hovers = this.hover != null && this.chart;
    show(this.when, hovers ? ` at ${bus_time(this.chart.data[0][this.hover], 2)}` : "");
    spec.lines.forEach((line, i) => {
      const row = this.store.at(this.node, line.message, hovers ? this.chart.data[0][this.hover] : this.view.range.to_s);
      show(this.legend[i], fixed(hovers ? this.#under_cursor(i) : row?.[line.column] * spec.factor, spec.decimals));
      const old = row && line.column in AGES && is_old(row[AGES[line.column]]);
      this.legend[i].classList.toggle("old", Boolean(old));
      this.legend[i].title = old ? measured_ago(row[AGES[line.column]]) : "";
    });
  }

  #under_cursor(line) {
    const points = this.chart.data[line + 1];
    let place = this.hover;
    while (place > 0 && points[place] === undefined) --place;
    return points[place];
  }
}
