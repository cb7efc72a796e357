// A number in a sentence of the tour: changed by horizontal drags, by clicks on the arrows beside it,
// or by the keys of a slider.

const pixels = 10; // drag distance per value
const click = 3; // a drag is longer [CSS pixel]
const page = 4; // values per Page Up or Page Down

const keys = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: page,
  PageDown: -page, Home: -Infinity, End: Infinity };

/** The index of a value among the stops; halfway between two of them if not equal. */
function indexOf(stops, value) {
  const above = stops.findIndex((stop) => stop >= value * (1 - 1e-9));
  if (above < 0) return stops.length - 0.5;
  return Math.abs(stops[above] - value) <= 1e-9 * value ? above : above - 0.5;
}

/**
 * The value a number of stops further.
 * @returns undefined if the value lies beyond the last stop in that direction
 */
function moved(stops, from, by) {
  if (by > 0 ? from > stops.length - 1 : from < 0) return undefined;
  const index = by > 0 ? Math.floor(from) + by : Math.ceil(from) + by;
  return stops[Math.min(stops.length - 1, Math.max(0, index))];
}

/**
 * @param {(value: number) => void} change called during changes
 * @param {() => void} settle called when a drag ends, and after a key
 * @returns {element, show}; show takes the number as reported by the laboratory
 */
export function makeNumber(change, settle) {
  const element = document.createElement("span");
  element.className = "substep-number";
  element.tabIndex = 0;
  element.setAttribute("role", "slider");
  let now = { stops: [0], value: 0 };
  let drag = null; // {x, index, value} at the start; {by}: offset so far; {still}: a click

  const set = (value) => {
    if (value !== undefined && value !== now.value) change(value);
  };
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    element.setPointerCapture(event.pointerId);
    element.focus({ preventScroll: true });
    drag = { x: event.clientX, index: indexOf(now.stops, now.value), value: now.value,
      by: 0, still: true };
    event.preventDefault(); // no text selection
  });
  element.addEventListener("pointermove", (event) => {
    if (!drag) return;
    if (Math.abs(event.clientX - drag.x) > click) drag.still = false;
    const by = Math.round((event.clientX - drag.x) / pixels);
    if (by !== drag.by) set(by === 0 ? drag.value : moved(now.stops, drag.index, by));
    drag.by = by;
  });
  element.addEventListener("pointerup", (event) => {
    if (!drag?.still) return;
    const { left, width } = element.getBoundingClientRect();
    const at = (event.clientX - left) / width;
    const by = at < 1 / 3 ? -1 : at > 2 / 3 ? 1 : 0; // the arrows fill the outer thirds
    const value = by === 0 ? undefined : moved(now.stops, drag.index, by);
    drag = null;
    if (value === undefined) return;
    set(value);
    settle();
  });
  for (const type of ["pointerup", "pointercancel"]) {
    element.addEventListener(type, () => {
      if (drag && now.value !== drag.value) settle();
      drag = null;
    });
  }
  element.addEventListener("keydown", (event) => {
    const by = keys[event.key];
    if (by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    set(moved(now.stops, indexOf(now.stops, now.value), by));
    settle();
  });

  return {
    element,
    /** @param number {label, value, text, stops} */
    show(number) {
      const changed = number.value !== now.value || number.text !== now.text;
      now = number;
      if (!changed) return;
      element.textContent = number.text;
      const attributes = { label: number.label, valuenow: number.value, valuetext: number.text,
        valuemin: number.stops[0], valuemax: number.stops.at(-1) };
      for (const [name, value] of Object.entries(attributes)) {
        element.setAttribute(`aria-${name}`, value);
      }
    },
  };
}
