// The elements of a laboratory on the page: the canvas, its HTML equivalent, and a card over both for
// progress and errors.

let instances = 0;

const markup = (id, wholePage) => `
${wholePage ? '<section class="substep-tour" hidden></section>' : ""}
<canvas class="substep-view" tabindex="0" role="application" aria-describedby="${id}-twin"
  aria-label="substep: simulation, controls and plots"></canvas>
<section class="substep-twin" id="${id}-twin" aria-label="State of the simulation"></section>
<div class="substep-overlay">
  <div class="substep-card">
    <img class="substep-picture" width="880" height="495" hidden
      alt="A box of 1000 kg swings on a chain of light links; plots show sub-steps and energy.">
    <h2></h2>
    <p></p>
    <progress max="1" value="0" aria-label="Loading"></progress>
    <button type="button" hidden></button>
  </div>
</div>`;

/** Adds the module's styles, once for all laboratories of a page. */
function addStyles(name) {
  const href = new URL(name, import.meta.url).href;
  if ([...document.styleSheets].some((sheet) => sheet.href === href)) return;
  const link = Object.assign(document.createElement("link"), { rel: "stylesheet", href });
  document.head.append(link);
}

export function makeFrame(element, wholePage) {
  addStyles("substep.css");
  if (wholePage) addStyles("tour.css");
  element.classList.add("substep");
  element.classList.toggle("substep-shares", !wholePage); // wheel and touch are shared with the page
  element.innerHTML = markup(`substep-${++instances}`, wholePage);
  const ending = new AbortController();
  const canvas = element.querySelector("canvas");
  const overlay = element.querySelector(".substep-overlay");
  const heading = overlay.querySelector("h2");
  const message = overlay.querySelector("p");
  const bar = overlay.querySelector("progress");
  const button = overlay.querySelector("button");
  const picture = overlay.querySelector("img");

  const say = (title, text, { working = false, answer = "", pictured = false } = {}) => {
    overlay.hidden = false;
    picture.hidden = !pictured;
    if (pictured) picture.src = new URL("picture.webp", import.meta.url).href;
    overlay.setAttribute("role", working ? "status" : "alert");
    heading.textContent = title;
    message.textContent = text;
    bar.hidden = !working;
    button.hidden = answer === "";
    button.textContent = answer;
  };
  return {
    element,
    canvas,
    wholePage,
    signal: ending.signal, // for listeners outside the canvas
    twin: element.querySelector(".substep-twin"),
    tour: element.querySelector(".substep-tour"), // null in an article
    say,
    /** Shows a message and waits for its button. */
    ask(title, text, answer) {
      say(title, text, { answer });
      return new Promise((done) => button.addEventListener("click", done, { once: true }));
    },
    progress(share) { bar.value = share; },
    clear() { overlay.hidden = true; },
    /** Applies the theme of the laboratory to the HTML. */
    paint(dark) { element.dataset.theme = dark ? "dark" : "light"; },
    /** Ends listeners outside the canvas. */
    stop() { ending.abort(); },
    /** Restores the element. */
    end() {
      ending.abort();
      element.replaceChildren();
      element.classList.remove("substep-touring");
      delete element.dataset.theme;
    },

    /** Matches the drawing buffer to the screen's pixels. @returns whether it changed */
    fit(wasm) {
      const ratio = window.devicePixelRatio || 1;
      const box = canvas.getBoundingClientRect();
      const width = Math.max(1, Math.round(box.width * ratio));
      const height = Math.max(1, Math.round(box.height * ratio));
      const changed = canvas.width !== width || canvas.height !== height;
      if (changed) {
        canvas.width = width;
        canvas.height = height;
      }
      wasm.resize(width / ratio, height / ratio, ratio);
      return changed;
    },
  };
}
