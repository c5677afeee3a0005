// Keys of the view. The space bar belongs to STOP (stop.js) alone.

const TYPES = "input[type=number], input[type=text], select, textarea";

/** actions: key → function. Ignores keys while the user types, and the browser's own combinations. */
export function listen_to_keys(actions) {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.matches?.(TYPES)) return;
    const moves = event.key.startsWith("Arrow") || event.key === "Home" || event.key === "End";
    if (moves && event.target.matches?.("input, [role=tab], [role=log]")) return;
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/** Wheel over a plot: with Ctrl zooms, with Shift pans; otherwise the page scrolls as usual. */
export function listen_to_wheel(place, view) {
  place.addEventListener("wheel", (event) => {
    const plot = event.target.closest?.(".u-over");
    if (!plot || !(event.ctrlKey || event.shiftKey)) return;
    event.preventDefault();
    const { left, width } = plot.getBoundingClientRect();
    const distance = event.deltaY || event.deltaX;
    if (event.ctrlKey) view.zoom(1.2 ** Math.sign(distance), (event.clientX - left) / width);
    else view.pan(0.1 * Math.sign(distance));
  }, { passive: false });
}
