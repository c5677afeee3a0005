// Finds problems of the page's present layout: texts and controls that overlap, reach out of their containers, or are
// too small to be hit. Called by accessibility_test.py with the min size of a target in pixels.

const MIN_TARGET_PX = arguments[0];
// Line boxes of one font may touch.
const TOUCH_PX = 3;
const HOLDERS = "button, .card, .plot, .readouts, header, dialog, #replay, #stop-notice, body";
const CONTROLS = "button, input, select, summary, progress, [role=meter], canvas";

const is_seen = (element) => element.checkVisibility({ opacityProperty: true, visibilityProperty: true }) && !element.closest("legend");

/** The part of a rectangle that the scrolling containers around the element leave visible. */
function clipped({ left, right, top, bottom }, element) {
  for (let around = element; around && around !== document.body; around = around.parentElement) {
    if (getComputedStyle(around).overflow === "visible") continue;
    const box = around.getBoundingClientRect();
    left = Math.max(left, box.left);
    right = Math.min(right, box.right);
    top = Math.max(top, box.top);
    bottom = Math.min(bottom, box.bottom);
  }
  return { left, right, top, bottom };
}

function texts() {
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (node.data.trim() === "" || element.closest("script, option, noscript") || !is_seen(element)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const box of range.getClientRects()) found.push({ element, name: node.data.trim(), ...clipped(box, element), all: box });
  }
  return found;
}

const controls = () => [...document.querySelectorAll(CONTROLS)].filter(is_seen).map((element) => {
  const box = element.getBoundingClientRect();
  return { element, name: element.getAttribute("aria-label") ?? `${element.tagName} ${element.textContent}`, ...clipped(box, element), all: box };
});

const overlap = (a, b) =>
  Math.min(a.right, b.right) - Math.max(a.left, b.left) > TOUCH_PX && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > TOUCH_PX;
// Dialogs may cover the page, and on a phone STOP may too.
const floats = (element) => element.closest("dialog") || (element.closest("#stop") && innerWidth <= 640);

const problems = [];
const pieces = [...texts(), ...controls()];
pieces.forEach((a, i) => {
  for (const b of pieces.slice(i + 1)) {
    if (a.element.contains(b.element) || b.element.contains(a.element) || floats(a.element) || floats(b.element)) continue;
    if (overlap(a, b)) problems.push(`${a.name} and ${b.name} overlap`);
  }
  const holder = a.element.closest(HOLDERS).getBoundingClientRect();
  const inside = clipped(a.all, a.element);
  if (inside.right > holder.right + 1 || inside.left < holder.left - 1) problems.push(`${a.name} reaches out of its container`);
});
for (const element of document.querySelectorAll("button, input, select, summary, [tabindex]")) {
  // A hidden radio button is hit by its label.
  const target = element.matches("fieldset input") ? element.parentElement : element;
  if (!is_seen(target)) continue;
  const { width, height } = target.getBoundingClientRect();
  if (width < MIN_TARGET_PX || height < MIN_TARGET_PX)
    problems.push(`${element.getAttribute("aria-label") ?? element.value} ${element.textContent} is ${width.toFixed(0)} x ${height.toFixed(0)} px`);
}
if (document.documentElement.scrollWidth > innerWidth) problems.push(`scrolls sideways, ${document.documentElement.scrollWidth} px`);
return [...new Set(problems)];
