// One plot: some columns of a node over time, its limits as lines, its newest values as text.

import { bucket_times, decimate } from "./decimate.js";
import { element, show } from "./dom.js";
import { AGES, bus_time, decimals_of, fixed, is_old, measured_ago, significant } from "./format.js";

const HEIGHT_PX = 176;
const TIME_STEPS_S = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600];
// Messages come ten times a second or more often; without one for so long something was lost.
const GAP_S = 1;

/** A colour of style.css, as it is in light or dark. */
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** For whoever measures how soon the first plot is there. */
function tell_first_plot() {
  if (performance.getEntriesByName("first-plot").length === 0) performance.mark("first-plot");
}

export class Plot {
  /**
   * spec: {title, unit, factor, decimals, min_span, from_zero, lines: [{message, column, name, colour, dash, fill}],
   * band: [upper, lower] places in lines, mark: {message, column}: drawn as a strip while it is 1,
   * limit: fault whose limit is drawn}; what is shown is the column times factor. limits: of the detectors, by fault.
   */
  constructor(spec, node, store, view, limits) {
    Object.assign(this, { spec, node, store, view, limits, seen: false, hover: null });
    this.legend = spec.lines.map(() => element("b", {}, "–"));
    this.when = element("span", { class: "when" });
    this.hole = element("div", { class: "canvas" });
    this.element = element("figure", { class: "plot", "aria-label": `${spec.title}, node ${node}` },
      element("figcaption", {}, element("h3", {}, `${spec.title} `, element("span", { class: "unit" }, spec.unit), this.when), element("ul", { class: "legend" }, ...this.#legend())),
      this.hole);
    new ResizeObserver(() => this.#resize()).observe(this.hole);
    new IntersectionObserver(([entry]) => this.#show_or_hide(entry.isIntersecting)).observe(this.element);
  }

  #legend() {
    return this.spec.lines.map((line, i) =>
      element("li", { style: `--line: var(--${line.colour})`, class: line.dash ? "dashed" : "" },
        `${line.name} `, this.legend[i]));
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
    const axis = { stroke: () => colour("ink-2"), grid: { stroke: () => colour("grid"), width: 1 }, font: "11px system-ui",
      ticks: { show: false } };
    return {
      width, height: HEIGHT_PX, pxAlign: 1, legend: { show: false }, padding: [16, 18, 0, 0],
      cursor: { sync: { key: "time" }, y: false, points: { size: 6 }, drag: { x: true, y: false, setScale: false },
        bind: { dblclick: () => () => this.view.follow() } },
      scales: { x: { time: false }, y: { range: (_, least, greatest) => this.#span(least, greatest) } },
      axes: [
        { ...axis, size: 27, gap: 8, incrs: TIME_STEPS_S, space: 70,
          values: (_, times, axis, space, step) => times.map((time) => bus_time(time, decimals_of(step))) },
        { ...axis, size: 46, gap: 4, space: 28, values: (_, values, axis, space, step) => values.map((value) => fixed(value, decimals_of(step))) },
      ],
      series: [{}, ...spec.lines.map((line) => ({
        stroke: () => colour(line.colour), width: line.width ?? 1.5, dash: line.dash, points: { show: false },
        fill: line.fill ? () => `${colour(line.colour)}22` : undefined }))],
      bands: spec.band ? [{ series: spec.band.map((line) => line + 1), fill: () => `${colour("band")}` }] : [],
      hooks: { draw: [() => this.#draw_limits()], setCursor: [(chart) => (this.hover = chart.cursor.idx)],
        setSelect: [(chart) => this.#selected(chart)] },
    };
  }

  /** Ends at round numbers: the axis stands still while the values tremble. */
  #span(least, greatest) {
    let low = least ?? 0;
    let high = greatest ?? 0;
    const limit = this.#limit;
    if (this.spec.from_zero) low = Math.min(0, low);
    if (limit !== null && (this.spec.show_limit || high > 0.8 * limit)) high = Math.max(high, limit * 1.04);
    const missing = this.spec.min_span - (high - low);
    if (missing > 0) {
      high += this.spec.from_zero ? missing : missing / 2;
      low -= this.spec.from_zero ? 0 : missing / 2;
    }
    const step = 10 ** Math.floor(Math.log10(high - low)) / 2;
    // Noise about a round number is not given a step of its own.
    return [Math.floor(low / step + 0.05) * step, Math.ceil((high + 0.03 * (high - low)) / step) * step];
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

  /** A pause of rows that is none of their rhythm. */
  #gap_s(table) {
    return Math.max(GAP_S, 4 * table.period_s);
  }

  #points(message, columns, range, buckets) {
    const table = this.store.table(this.node, message);
    if (!table || table.empty) return columns.map(() => new Array(2 * buckets).fill(null));
    return decimate(table, columns, range.from_s, range.to_s, buckets, this.#gap_s(table));
  }

  draw() {
    const range = this.view.range;
    if (!this.chart || !this.seen || Number.isNaN(range.to_s)) return;
    const { spec } = this;
    const buckets = Math.max(50, Math.floor(this.chart.bbox.width / devicePixelRatio));
    const columns = new Map();
    for (const line of spec.lines) columns.set(line.message, [...(columns.get(line.message) ?? []), line.column]);
    const points = new Map();
    for (const [message, names] of columns)
      this.#points(message, names, range, buckets).forEach((line, i) => points.set(`${message}.${names[i]}`, line));
    const lines = spec.lines.map((line) => points.get(`${line.message}.${line.column}`).map((value) => value && value * spec.factor));
    this.marked = spec.mark && this.#points(spec.mark.message, [spec.mark.column], range, buckets)[0];
    this.chart.batch(() => {
      this.chart.setData([bucket_times(range.from_s, range.to_s, buckets), ...lines], false);
      this.chart.setScale("x", { min: range.from_s, max: range.to_s });
    });
    tell_first_plot();
  }

  #draw_limits() {
    const { ctx, bbox, data } = this.chart;
    ctx.save();
    if (this.marked) {
      ctx.fillStyle = colour("warn");
      const width = (2 * bbox.width) / this.marked.length;
      this.marked.forEach((value, i) => {
        if (value >= 0.5) ctx.fillRect(this.chart.valToPos(data[0][i], "x", true), bbox.top, width, 3 * devicePixelRatio);
      });
    }
    if (this.#limit !== null) this.#draw_limit(this.#limit, ctx, bbox);
    ctx.restore();
  }

  #draw_limit(limit, ctx, bbox) {
    const place = this.chart.valToPos(limit, "y", true);
    const above = place < bbox.top;
    const below = place > bbox.top + bbox.height;
    ctx.strokeStyle = ctx.fillStyle = colour("fault");
    ctx.font = `${10 * devicePixelRatio}px system-ui`;
    ctx.textAlign = "right";
    ctx.textBaseline = "bottom";
    const text = `limit ${significant(limit)} ${this.spec.unit}${above ? " ↑" : below ? " ↓" : ""}`;
    // Beyond the plot it stands in the margin, where no line crosses it.
    const bottom = Math.min(Math.max(place, bbox.top), bbox.top + bbox.height);
    ctx.fillText(text, bbox.left + bbox.width, bottom - 3 * devicePixelRatio);
    if (above || below) return;
    ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, place);
    ctx.lineTo(bbox.left + bbox.width, place);
    ctx.stroke();
  }

  /** The values under the cursor, or the newest that are seen. */
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
