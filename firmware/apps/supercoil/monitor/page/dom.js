// Making and changing elements.

/** An element with attributes and children; on… attributes are listeners. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== null && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children);
  return made;
}

/** A table that scrolls sideways if there is no room, by the keyboard too. */
export const scrolling = (label, table) => element("div", { class: "sideways", role: "region", "aria-label": label, tabindex: 0 }, table);

/** A colour of style.css, for the current light or dark theme. */
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Writes only changes: the layout is not recomputed needlessly. */
export function show(where, text) {
  if (where.textContent !== text) where.textContent = text;
}

/** Puts a child where its number belongs among its numbered siblings. */
export function place(parent, number, child) {
  child.dataset.number = number;
  const behind = [...parent.children].find((other) => Number(other.dataset.number) > number);
  parent.insertBefore(child, behind ?? null);
}
