// The laboratory in plain HTML for screen readers and keyboards: its state, announced when
// important, and its main controls. The controls become visible on keyboard focus.

const touched = 250; // after a touch, until the application knows what it was for [ms]
const period = 1000; // between updates; more frequent ones would distract [ms]

const fields = { scene: "Scene", method: "Method", state: "State",
  substeps: "Sub-steps per frame", energy: "Energy", verdict: "Verdict" };

const markup = (id) => `
<p data-introduction hidden></p>
<form class="substep-keys" aria-label="Controls">
  <button type="button" name="enter" hidden>Try it</button>
  <button type="button" name="tour" hidden>Tour</button>
  <label for="${id}-scene">Scene</label><select id="${id}-scene" name="scene"></select>
  <label for="${id}-mode">Stabilisation</label><select id="${id}-mode" name="mode"></select>
  <label for="${id}-solver">Solver</label><select id="${id}-solver" name="solver"></select>
  <label for="${id}-alpha">Alpha</label>
  <input id="${id}-alpha" name="alpha" type="number" min="0.001" max="1" step="any">
  <button type="button" name="play">Play</button>
  <button type="button" name="step">One frame</button>
  <button type="button" name="reset">Reset</button>
  <button type="button" name="text" aria-expanded="false">Edit as text</button>
  <div class="substep-source" hidden>
    <label for="${id}-source">Scene as text</label>
    <textarea id="${id}-source" name="source" rows="8" spellcheck="false"></textarea>
    <button type="button" name="apply">Apply text</button>
    <ul></ul>
  </div>
  <button type="button" name="new" data-edit="new">New scene</button>
  <button type="button" name="hand" aria-expanded="false">Edit by hand</button>
  <div class="substep-hand" hidden>
    <label for="${id}-body">Body</label><select id="${id}-body" name="select"></select>
    ${["link", "ball", "box", "copy", "delete", "undo", "redo"].map((edit) =>
    `<button type="button" data-edit="${edit}">${edit}</button>`).join("")}
    <label for="${id}-edit">Change, for example mass:5 or connect:floor</label>
    <input id="${id}-edit" name="edit">
  </div>
</form>
<dl>${Object.entries(fields).map(([name, title]) =>
    `<dt>${title}</dt><dd data-field="${name}"></dd>`).join("")}</dl>
<p role="status" aria-live="polite"></p>`;

function fill(select, entries) {
  select.replaceChildren(...entries.map(([value, text]) => new Option(text, value)));
}

export function makeTwin(section, calls) {
  section.innerHTML = markup(section.id);
  const form = section.querySelector("form");
  const live = section.querySelector("[aria-live]");
  const { enter, tour, scene, mode, solver, alpha, play, step, reset, hand, select: body, text,
    source, apply } = form.elements;
  const byHand = section.querySelector(".substep-hand");
  const editor = section.querySelector(".substep-source");
  const faults = editor.querySelector("ul");
  const introduction = section.querySelector("[data-introduction]");
  const shown = Object.fromEntries(
    [...section.querySelectorAll("[data-field]")].map((e) => [e.dataset.field, e]));

  // "none, const or capped": the allowed values in words.
  const choices = (name) => calls.settings().find((s) => s.name === name).allowed
    .split(/, | or /).map((word) => [word, word]);
  fill(mode, choices("mode"));
  fill(solver, choices("solver"));

  // The canvas makes room for the controls while these are in sight.
  const host = section.parentElement;
  const makeRoom = () => {
    const shown = section.contains(document.activeElement);
    host.style.setProperty("--substep-bar", shown ? `${section.offsetHeight}px` : "0px");
  };
  section.addEventListener("focusin", makeRoom);
  section.addEventListener("focusout", () => setTimeout(makeRoom)); // until the focus is elsewhere

  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("change", ({ target }) => {
    if (target === source) return; // it has its own button
    const { problems } = calls.set({ [target.name]: target.value });
    if (problems.length > 0) live.textContent = `${target.name}: ${problems[0].message}`;
    update();
  });
  const follow = (settings, next) => {
    calls.set(settings);
    update();
    next.focus(); // the focused button was removed
  };
  enter.addEventListener("click", () => follow({ introduction: "off" }, scene));
  tour.addEventListener("click", () => follow({ tour: 1 }, scene));
  play.addEventListener("click", () => {
    calls.report().playing ? calls.pause() : calls.play();
    update();
  });
  step.addEventListener("click", () => {
    calls.pause();
    calls.step();
    update();
  });
  reset.addEventListener("click", () => {
    calls.reset();
    update();
  });

  // Bodies by hand.
  let bodies = "";
  function fillBodies(selected) {
    if (byHand.hidden) return;
    let names = [];
    try {
      names = JSON.parse(calls.sceneText().text).bodies.map(({ name }) => name);
    } catch { /* it is being written */ }
    if (names.join("\n") !== bodies) fill(body, ["none", ...names].map((name) => [name, name]));
    bodies = names.join("\n");
    put(body, selected || "none");
  }
  hand.addEventListener("click", () => {
    byHand.hidden = !byHand.hidden;
    hand.setAttribute("aria-expanded", String(!byHand.hidden));
    update();
    makeRoom();
  });
  for (const button of form.querySelectorAll("[data-edit]")) {
    button.addEventListener("click", () => {
      const { problems } = calls.set({ edit: button.dataset.edit });
      if (problems.length > 0) live.textContent = problems[0].message;
      update();
    });
  }

  // The scene as text: that of the run, unless it has changes here.
  let filled = ""; // with what the field was filled
  function fillSource() {
    if (editor.hidden || source.value !== filled) return;
    const { text: now } = calls.sceneText();
    if (now !== filled) source.value = filled = now;
  }
  function openText() {
    editor.hidden = false;
    text.setAttribute("aria-expanded", "true");
    fillSource();
    source.setSelectionRange(0, 0); // else the end is in sight
    source.focus();
    makeRoom();
  }
  text.addEventListener("click", () => {
    if (editor.hidden) return openText();
    editor.hidden = true;
    text.setAttribute("aria-expanded", "false");
    makeRoom();
  });
  apply.addEventListener("click", () => {
    const { problems } = calls.editText(source.value);
    if (problems.length === 0) filled = source.value;
    faults.replaceChildren(...problems.slice(0, 100).map(({ line, pointer, message }) => {
      const place = [line && `Line ${line}`, pointer].filter(Boolean).join(", ");
      return Object.assign(document.createElement("li"),
        { textContent: place ? `${place}: ${message}` : message });
    }));
    live.textContent = problems.length === 0 ? "The text runs"
      : `${problems.length} ${problems.length === 1 ? "problem" : "problems"}. ${faults.firstChild.textContent}`;
    update();
    makeRoom();
  });
  // A touch screen shows its keyboard for an HTML field only.
  host.querySelector("canvas").addEventListener("pointerup", ({ pointerType }) => {
    if (pointerType !== "touch") return;
    setTimeout(() => { if (calls.report().typing) openText(); }, touched);
  });

  /** The first screen as text. @returns the part to announce once */
  function introduce(words) {
    for (const part of [introduction, enter, tour]) part.hidden = !words;
    if (!words) return "";
    const text = `${words.purpose}. ${words.claim} Left: ${words.torn}. Right: ${words.held}. `
      + `${words.paper}.`;
    if (introduction.textContent !== text) introduction.textContent = text;
    return `${words.claim} ${words.paper}. Enter or Escape leads to the laboratory`;
  }

  const inTour = () => section.parentElement?.classList.contains("substep-touring");

  let said = "";
  let updatedAt = -Infinity;
  let names = "";
  const put = (control, value) => {
    if (document.activeElement !== control && control.value !== value) control.value = value;
  };

  function update() {
    updatedAt = performance.now();
    const r = calls.report();
    const state = r.stopped ? "stopped" : r.playing ? "playing" : "paused";
    const values = {
      scene: r.title,
      method: `${r.mode}, ${r.solver}, ${r.integrator}, alpha ${r.alpha}`,
      state: `${state} at ${r.time.toFixed(1)} s`,
      substeps: String(r.substeps),
      energy: r.kinetic === null ? "not finite" : `${(r.kinetic / 1000).toFixed(2)} kJ kinetic`,
      verdict: r.verdict,
    };
    for (const [name, value] of Object.entries(values)) {
      if (shown[name].textContent !== value) shown[name].textContent = value;
    }
    const scenes = calls.scenes();
    const now = scenes.map((s) => s.name).join();
    if (now !== names) fill(scene, scenes.map((s) => [s.name, s.title]));
    names = now;
    fillSource();
    fillBodies(r.selected);
    put(scene, r.scene);
    put(mode, r.mode);
    put(solver, r.solver);
    put(alpha, String(Number(r.alpha.toPrecision(6))));
    play.textContent = r.playing ? "Pause" : "Play";
    // Announces only relevant changes, not every changing number.
    const run = [r.title, r.mode, state, r.verdict].join(", ");
    // A run of the tour repeats; its result is announced beside its text.
    const seen = introduce(r.introduction) || (inTour() ? `Guided tour, step ${r.tour}` : run);
    const words = [seen, r.trouble, r.notice].filter(Boolean).join(", ");
    if (words !== said) live.textContent = said = words;
  }

  update();
  return {
    afterDraw() {
      if (performance.now() - updatedAt > period) update();
    },
  };
}
