// A joint of two muscles, as reported by its nodes' board: a picture of its angle, and what each muscle does.

import { element, show } from "./dom.js";
import { fixed, words } from "./format.js";
import { DEGREES, joint_of } from "./joint.js";

const SVG = "http://www.w3.org/2000/svg";
// The picture, in pixels from the pivot. A larger angle is drawn at the max.
const LEVER = 24, ARM = 78, FOOT = 66, MAX_DEG = 80;

const drawn = (name, attributes, ...children) => {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
};
/** Degrees to the right of upright, as far as the picture has room. */
const turned = (angle_deg) => `rotate(${Number.isFinite(angle_deg) ? Math.max(-MAX_DEG, Math.min(MAX_DEG, angle_deg)).toFixed(2) : 0})`;

export class JointCard {
  constructor(node, store) {
    Object.assign(this, { node, store });
    this.reference = drawn("line", { class: "reference", y1: 0, y2: -ARM });
    this.muscles = [drawn("line", { class: "muscle" }), drawn("line", { class: "muscle" })];
    this.limb = drawn("g", { class: "limb" }, drawn("line", { x1: -LEVER, x2: LEVER }), drawn("line", { y1: 0, y2: -ARM }), drawn("circle", { r: 4 }));
    const picture = drawn("svg", { viewBox: "-95 -90 190 160", role: "img", "aria-label": "the joint at its angle, its reference dashed" },
      this.reference, ...this.muscles, this.limb);
    this.values = ["angle", "reference", "turns right", "turns left", "both pull with"].map((name) => {
      const title = element("dt", {}, name), value = element("dd", {}, "–");
      return { title, value, line: element("div", {}, title, value) };
    });
    this.element = element("section", { class: "card joint full-only", "aria-label": `joint of node ${node}`, hidden: true },
      element("h2", {}, "Joint"), picture, element("dl", { class: "facts" }, ...this.values.map(({ line }) => line)));
  }

  update(now_s) {
    const joint = joint_of(this.store, this.node, now_s);
    this.element.hidden = !joint;
    if (!joint) return;
    const { lever_m, other } = joint;
    const [right, left] = lever_m > 0 ? [this.node, other] : [other, this.node];
    // Each muscle may pull at its own lever.
    const { lever } = lever_m > 0 ? joint : joint_of(this.store, right, now_s) ?? joint;
    const degrees = (message, column) => lever.angle_rad(this.store.at(right, message, now_s)?.[column]) * DEGREES;
    const angle_deg = degrees("Measurement", "position_m"), reference_deg = degrees("Tracking", "reference_m");
    this.limb.setAttribute("transform", turned(angle_deg));
    this.reference.setAttribute("transform", turned(reference_deg));
    this.reference.style.display = Number.isFinite(reference_deg) ? "" : "none";
    this.muscles.forEach((muscle, i) => this.#draw(muscle, i === 0 ? 1 : -1, angle_deg));
    show(this.values[0].value, `${fixed(angle_deg, 2)}°`);
    show(this.values[1].value, `${fixed(reference_deg, 2)}°`);
    // A spring has no node.
    this.muscles[1].style.display = other === null ? "none" : "";
    for (const { line } of this.values.slice(3)) line.hidden = other === null;
    const antagonist = lever_m > 0 ? other : this.node;
    const is_led = this.store.word("Status", "mode", this.store.at(antagonist, "Status", now_s)?.mode) === "joint";
    show(this.values[4].value, is_led ? `${fixed(this.store.at(antagonist, "Power", now_s)?.demanded_W, 2)} W of node ${antagonist}, commanded` : "–");
    [right, left].filter((node) => node !== null).forEach((node, i) => {
      const hot = this.store.at(node, "Temperature", now_s), power = this.store.at(node, "Power", now_s);
      const limit = power?.limited_by > 0 ? `, limited by ${words(this.store.word("Power", "limited_by", power.limited_by))}` : "";
      const { title, value } = this.values[2 + i];
      show(title, `node ${node}, turns ${i === 0 ? "right" : "left"}`);
      show(value, `${fixed(power?.applied_W, 2)} W, ${fixed(hot?.coldest_C, 0)} … ${fixed(hot?.hottest_C, 0)} °C${limit}`);
    });
  }

  /** Draws the muscle from its fixed end to the end of the lever that it pulls down. */
  #draw(muscle, side, angle_deg) {
    const angle = (Number.isFinite(angle_deg) ? Math.max(-MAX_DEG, Math.min(MAX_DEG, angle_deg)) : 0) / DEGREES;
    const ends = { x1: side * LEVER, y1: FOOT, x2: side * LEVER * Math.cos(angle), y2: side * LEVER * Math.sin(angle) };
    for (const [key, at] of Object.entries(ends)) muscle.setAttribute(key, at.toFixed(2));
  }
}
