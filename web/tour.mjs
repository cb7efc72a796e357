// The guided tour as HTML beside the canvas. Its sentences, numbers and replies come from the
// application (app/text/tour.cpp); changes go through the API.
import { makeNumber } from "./tour_number.mjs";

const shownFor = 2500; // duration of a mark after a click [ms]

const markup = (id) => `
<p class="substep-tour-where"></p>
<div class="substep-tour-close"><button type="button" name="close" aria-label="Close the tour"><svg
  viewBox="0 0 16 16" aria-hidden="true"><path d="M3 3l10 10M13 3L3 13"/></svg></button></div>
<div class="substep-tour-body">
  <h2 id="${id}" tabindex="-1"></h2>
  <p data-part="text"></p>
  <p data-part="watch"></p>
  <div class="substep-tour-task">
    <p data-part="task"></p>
    <p data-part="now"></p>
    <p data-part="reply" role="status" aria-live="polite"></p>
  </div>
</div>
<div class="substep-tour-steps">
  <button type="button" name="back">Back</button>
  <button type="button" name="next">Next</button>
</div>`;

/** Marks a place of the canvas with a ring. */
function makeRing(frame, calls) {
  const ring = document.createElement("div");
  ring.className = "substep-ring";
  ring.hidden = true;
  frame.element.append(ring);
  let place = null;
  let until = Infinity; // [ms]
  const follow = () => {
    if (place && performance.now() > until) place = null;
    const widgets = place ? calls.widgets() : []; // no list after the program has stopped
    const box = Array.isArray(widgets)
      && widgets.find((w) => w.group === place.group && w.label === place.label);
    ring.hidden = !box;
    if (!box) return;
    const { canvas } = frame;
    const edge = 4;
    Object.assign(ring.style, {
      left: `${canvas.offsetLeft + box.x - edge}px`, top: `${canvas.offsetTop + box.y - edge}px`,
      width: `${box.width + 2 * edge}px`, height: `${box.height + 2 * edge}px`,
    });
  };
  return {
    follow,
    show(wanted, time = Infinity) {
      place = wanted;
      until = performance.now() + time;
      follow();
    },
    hide() {
      place = null;
      follow();
    },
  };
}

/** A reference in a sentence: hover marks its place, a click opens it. */
function makePlace(part, ring, calls) {
  const button = Object.assign(document.createElement("button"),
    { type: "button", className: "substep-place", textContent: part.text });
  for (const type of ["pointerenter", "focus"]) {
    button.addEventListener(type, () => ring.show(part));
  }
  for (const type of ["pointerleave", "blur"]) button.addEventListener(type, () => ring.hide());
  button.addEventListener("click", () => {
    calls.set({ panel: part.panel });
    ring.show(part, shownFor);
  });
  return button;
}

/** @param frame contains the tour's section, frame.tour */
export function makeTour(frame, calls) {
  const section = frame.tour;
  const id = `${frame.twin.id}-tour`;
  section.setAttribute("aria-labelledby", id);
  section.innerHTML = markup(id);
  const parts = Object.fromEntries(
    [...section.querySelectorAll("[data-part]")].map((e) => [e.dataset.part, e]));
  const title = section.querySelector("h2");
  const where = section.querySelector(".substep-tour-where");
  const body = section.querySelector(".substep-tour-body");
  const task = section.querySelector(".substep-tour-task");
  const [close, back, next] = ["close", "back", "next"]
    .map((name) => section.querySelector(`button[name=${name}]`));
  const ring = makeRing(frame, calls);
  const numbers = new Map(); // in the sentences, by name
  let shown = 0; // the step, 0 outside the tour
  let words = null;
  let tried = false; // the user changed a number of this step

  const go = (step) => {
    calls.set({ tour: step });
    update();
  };
  close.addEventListener("click", () => go("off"));
  back.addEventListener("click", () => go(words.step - 1));
  next.addEventListener("click", () => go(words.step < words.count ? words.step + 1 : "off"));
  section.addEventListener("keydown", (event) => {
    if (event.key === "Escape") go("off");
  });

  const put = (element, text) => {
    if (element.textContent !== text) element.textContent = text;
  };

  function number(name) {
    const made = makeNumber(
      (value) => {
        tried = true;
        calls.set({ [name]: value });
        update();
      },
      () => {
        if (words?.numbers[name]?.from_start) calls.reset();
      });
    numbers.set(name, made);
    return made.element;
  }

  function fill(element, sentence) {
    element.replaceChildren(...sentence.map((part) => {
      if (part.number) return number(part.number);
      return part.label ? makePlace(part, ring, calls) : document.createTextNode(part.text);
    }));
    element.hidden = sentence.length === 0;
  }

  /** Shows the sentences of another step. */
  function tell() {
    const within = [section, frame.twin].some((e) => e.contains(document.activeElement));
    ring.hide();
    numbers.clear();
    tried = false;
    title.textContent = words.title;
    where.textContent = `Tour, ${words.step} of ${words.count}`;
    for (const name of ["text", "watch", "task"]) fill(parts[name], words[name]);
    section.style.setProperty("--substep-done", words.step / words.count);
    back.disabled = words.step === 1;
    next.textContent = words.step < words.count ? "Next" : "Done";
    body.scrollTop = 0;
    if (within) title.focus({ preventScroll: true }); // reading begins at the title
  }

  function open(on) {
    const within = section.contains(document.activeElement);
    ring.hide();
    section.hidden = !on;
    frame.element.classList.toggle("substep-touring", on);
    if (!on && within) frame.canvas.focus({ preventScroll: true });
  }

  function update() {
    words = calls.tour();
    const step = words?.step ?? 0;
    if ((step > 0) !== (shown > 0)) open(step > 0);
    const other = step !== shown;
    shown = step;
    if (step === 0) return;
    if (other) tell();
    for (const [name, { show }] of numbers) show(words.numbers[name]);
    put(parts.now, words.now);
    const answered = words.reply !== "" && words.reply !== parts.reply.textContent;
    put(parts.reply, words.reply);
    if (answered && tried) task.scrollIntoView({ block: "nearest" }); // may be out of sight on a phone
    task.classList.toggle("substep-tour-done", words.done);
  }

  update();
  return {
    afterDraw() {
      update();
      ring.follow();
    },
  };
}
