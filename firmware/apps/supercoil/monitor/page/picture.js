// A plot as a PNG: title, unit and legend above what its canvas shows.

import { colour } from "./dom.js";

const HEAD_PX = 44;

/** chart: of uPlot; lines: [{name, colour}]. Resolves to a Blob. */
export function picture_of(chart, title, lines) {
  const scale = devicePixelRatio;
  const { canvas } = chart.ctx;
  const sheet = document.createElement("canvas");
  Object.assign(sheet, { width: canvas.width, height: canvas.height + HEAD_PX * scale });
  const ctx = sheet.getContext("2d");
  ctx.fillStyle = colour("card");
  ctx.fillRect(0, 0, sheet.width, sheet.height);
  ctx.scale(scale, scale);
  ctx.fillStyle = colour("ink");
  ctx.font = "600 13px system-ui";
  ctx.fillText(title, 10, 18);
  ctx.font = "12px system-ui";
  let left = 10;
  for (const line of lines) {
    ctx.fillStyle = colour(line.colour);
    ctx.fillRect(left, 31, 16, 3);
    ctx.fillText(line.name, left + 21, 36);
    left += 35 + ctx.measureText(line.name).width;
  }
  ctx.resetTransform();
  ctx.drawImage(canvas, 0, HEAD_PX * scale);
  return new Promise((resolve) => sheet.toBlob(resolve, "image/png"));
}
