// What a plot shows besides its lines: limits, the strip while limited, another run, events.

import { colour } from "./dom.js";
import { significant } from "./format.js";

const LABEL_PX = 110; // nearer than this to the previous one, an event has no room for its name

/** An amber strip at the top where marked is 1, at the times of the chart's points. */
export function draw_strip({ ctx, bbox, data, valToPos }, marked) {
  ctx.fillStyle = colour("warn");
  const width = (2 * bbox.width) / marked.length;
  marked.forEach((value, i) => {
    if (value >= 0.5) ctx.fillRect(valToPos(data[0][i], "x", true), bbox.top, width, 3 * devicePixelRatio);
  });
}

export function draw_limit({ ctx, bbox, valToPos }, limit, unit) {
  const place = valToPos(limit, "y", true);
  const above = place < bbox.top;
  const below = place > bbox.top + bbox.height;
  ctx.strokeStyle = ctx.fillStyle = colour("fault");
  ctx.font = `${10 * devicePixelRatio}px system-ui`;
  ctx.textAlign = "right";
  ctx.textBaseline = "bottom";
  const text = `limit ${significant(limit)} ${unit}${above ? " ↑" : below ? " ↓" : ""}`;
  // A limit beyond the plot is labelled in the margin, where no line crosses it.
  const bottom = Math.min(Math.max(place, bbox.top), bbox.top + bbox.height);
  ctx.fillText(text, bbox.left + bbox.width, bottom - 3 * devicePixelRatio);
  if (above || below) return;
  ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
  ctx.beginPath();
  ctx.moveTo(bbox.left, place);
  ctx.lineTo(bbox.left + bbox.width, place);
  ctx.stroke();
}

/** Another run's line, pale, under the chart's own. points: values at times. */
export function draw_pale({ ctx, bbox, valToPos }, times, points, line_colour) {
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.beginPath();
  ctx.globalAlpha = 0.4;
  ctx.lineWidth = 3 * devicePixelRatio;
  ctx.strokeStyle = line_colour;
  let begun = false;
  points.forEach((value, i) => {
    if (value === undefined) return;
    if (value === null) return void (begun = false);
    const at = [valToPos(times[i], "x", true), valToPos(value, "y", true)];
    if (begun) ctx.lineTo(...at);
    else ctx.moveTo(...at);
    begun = true;
  });
  ctx.stroke();
  ctx.restore();
}

/** A vertical line for each event, {time_s, text, kind}, with its name where there is room. */
export function draw_events({ ctx, bbox, valToPos }, events) {
  ctx.save();
  ctx.font = `${10 * devicePixelRatio}px system-ui`;
  ctx.textAlign = "left";
  ctx.textBaseline = "bottom";
  ctx.lineWidth = devicePixelRatio;
  let free = bbox.left;
  for (const { time_s, text, kind } of events) {
    const place = Math.round(valToPos(time_s, "x", true)) + 0.5;
    ctx.strokeStyle = ctx.fillStyle = colour(kind === "warn" ? "fault" : "ink-2");
    ctx.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(place, bbox.top);
    ctx.lineTo(place, bbox.top + bbox.height);
    ctx.stroke();
    if (place < free || place + LABEL_PX * devicePixelRatio > bbox.left + bbox.width) continue;
    ctx.fillText(text.replace(": obeyed", ""), place + 3 * devicePixelRatio, bbox.top + bbox.height - 3 * devicePixelRatio, LABEL_PX * devicePixelRatio);
    free = place + LABEL_PX * devicePixelRatio;
  }
  ctx.restore();
}
