// The page of the step doctor: a model is dropped on it, its step is read, and its run is shown. What
// a file says is set as text, never as HTML.
import { createDoctor } from "./doctor.mjs";
import { badgeMarkdown, readFragment, writeFragment } from "./doctor_link.mjs";
import { digits, showAnswer, showDetails, stepText } from "./doctor_words.mjs";
import { examples } from "./doctor_examples.mjs";
import { copy, textOf } from "./files.mjs";
import { keepOffline } from "./offline.mjs";
import { createSubstep } from "./substep.mjs";

const at = (id) => document.getElementById(id);
const shortest = 1e-5; // of the slider [s]
const perDecade = 100; // its stops
const most = 1; // step that may be asked [s]
const reading = "Reading the step …";
const mostBodies = 500; // of a run that is shown: the page waits while it is loaded
const settling = 150; // of the slider before its run begins [ms]
const engineOf = { Euler: "mujoco", RK4: "mujoco", implicit: "mujoco-implicitfast",
  implicitfast: "mujoco-implicitfast", discrete: "mujoco-discrete" };

const state = {
  doctor: null,
  lab: null, // the laboratory, from the first model on
  opening: null, // a promise of it; of null, if this browser cannot show it
  model: null, // {text, name, isScene}
  base: null, // the scene of the run, whose frame is the step
  step: 0.002, // [s]
  diagnosis: null, // of the model, perhaps with an earlier step
  badge: "", // of it, in SVG
  html: "", // of it, as a page
  plays: !matchMedia("(prefers-reduced-motion: reduce)").matches,
  turn: 0, // counts questions: an answer to an earlier one is dropped
  runs: 0, // counts runs, likewise
};

const working = (text) => { at("working").textContent = text; };

/** Shows why a model was not opened. @param problems {pointer, message} */
function showTrouble(title, problems = []) {
  const box = at("trouble");
  box.hidden = title === "";
  const list = document.createElement("ul");
  for (const { pointer, message } of problems.slice(0, 10)) {
    list.append(Object.assign(document.createElement("li"),
      { textContent: pointer ? `${pointer}: ${message}` : message }));
  }
  if (problems.length > 10) {
    list.append(Object.assign(document.createElement("li"),
      { textContent: `and ${problems.length - 10} more` }));
  }
  const heading = Object.assign(document.createElement("strong"), { textContent: title });
  box.replaceChildren(heading, ...(problems.length > 0 ? [list] : []));
  working("");
}

const question = () => {
  const held = Number(at("held").value);
  return { engine: at("engine").value, step: state.step, ...(held > 0 ? { held } : {}) };
};

/** Shows a step in its controls. @param step [s] */
function setStep(step) {
  state.step = Number(Math.min(most, Math.max(shortest, step)).toPrecision(6));
  at("step").value = String(Math.round(perDecade * Math.log10(state.step / shortest)));
  at("step").setAttribute("aria-valuetext", stepText(state.step));
  at("exact").value = String(Number((1e3 * state.step).toPrecision(4)));
  compare();
}

/** What is known of the step before its own diagnosis: its ratio to the limit. */
function compare() {
  const limit = state.diagnosis?.largest_step ?? null;
  at("below").disabled = at("above").disabled = limit === null;
  at("limit").hidden = limit === null;
  if (limit !== null) {
    const place = Math.log10(limit / shortest) * perDecade / at("step").max;
    at("limit").style.setProperty("--place", String(Math.min(1, Math.max(0, place))));
    at("limit").classList.toggle("beyond", state.step > limit);
  }
  showAnswer(at("answer"), state.diagnosis, state.step);
}

/** Rings the joints that set the limit. */
function ring() {
  if (!state.lab) return;
  const names = (state.diagnosis?.joints ?? []).map((joint) => joint.name);
  const rung = names.length > 0 && state.lab.set({ ring: names.join(",") }).ok;
  if (!rung) state.lab.set({ ring: names[0] ?? "none" });
}

function showRun(verdict) {
  at("run").textContent = `At ${stepText(state.step)}: ${verdict === "holds" ? "holds so far" : verdict}`;
  at("run").className = verdict === "holds" ? "good" : "bad";
}

async function openLaboratory(scene) {
  try {
    state.lab = await createSubstep(at("laboratory"), { scene, play: false,
      settings: { panels: "off", cards: "off", tint: "off", masses: "off" } });
    state.lab.on("verdict", showRun);
    window.substep = state.lab;
  } catch {
    // Its element says why. The diagnosis needs no picture.
  }
  return state.lab;
}

/** Starts the run with the step, in the laboratory. */
async function run() {
  const turn = ++state.runs;
  const count = state.base.bodies.length;
  at("laboratory").hidden = count > mostBodies;
  if (count > mostBodies) {
    state.lab?.pause();
    at("run").textContent = `Not shown: it has ${count} bodies, more than ${mostBodies}`;
    at("run").className = "";
    return;
  }
  const scene = { ...state.base, frame: state.step };
  state.opening ??= openLaboratory(scene);
  const lab = await state.opening;
  if (!lab || turn !== state.runs) return; // a later run follows
  const { ok, problems } = lab.load(scene, state.model.name);
  if (!ok) showRun(problems[0].message);
  ring();
  if (state.plays) lab.play();
  else lab.pause();
  showRun(lab.report().verdict);
}

function show(diagnosis, isWhole) {
  state.diagnosis = diagnosis;
  compare();
  ring();
  at("held").parentElement.hidden = diagnosis.drives.length === 0;
  showDetails(at("details"), diagnosis, isWhole, apply);
  const { geometric } = diagnosis.start.reduce((least, group) => ({
    geometric: Math.min(least.geometric, group.geometric_step ?? Infinity) }), { geometric: Infinity });
  at("caveat").textContent = diagnosis.drives.length > 0 && (diagnosis.by_drive || diagnosis.joints.length === 0)
    ? "The drives of this laboratory are implicit and hold at any step: their limit does not show in "
      + `this run. ${geometric < Infinity ? `Geometric stiffness limits it to ${stepText(geometric)}.`
        : "Geometric stiffness sets no limit at the start."}`
    : "One step of the paper’s scheme per frame: joints are solved exactly, their geometric stiffness "
      + "is explicit, as in the engine.";
}

/** Applies a remedy: its step, or its model. */
async function apply(remedy, index) {
  if (!remedy.changes_model) return changeStep(remedy.step);
  const { engine, step, held } = question();
  const { name, opened } = state.model;
  const scene = await state.doctor.remedied(index);
  if (scene === "") return undefined;
  const changed = `${opened.name} with ${remedy.text}`;
  await open(scene, name, { engine, step, held }, changed);
}

const writeAddress = async () => {
  const { turn } = state;
  const fragment = await writeFragment(state.model, question());
  if (turn === state.turn) history.replaceState(null, "", `#${fragment}`);
};

/** Asks the doctor: what needs no run at once, then the rest. */
async function ask() {
  if (!state.model) return;
  const turn = ++state.turn;
  const asked = question();
  state.doctor.cancel(); // what is left of an earlier question
  working(reading);
  for (const runs of [false, true]) {
    if (runs) working("Running the model: from its start, after a shake, and at this step …");
    const { ok, problems, diagnosis } = await state.doctor.diagnose({ ...asked, runs });
    if (turn !== state.turn) return;
    if (!ok) return void showTrouble("The model could not be analysed", problems);
    show(diagnosis, runs);
    if (!runs) writeAddress();
    try { // while the doctor is free
      state.badge = await state.doctor.badge();
      state.html = await state.doctor.html();
    } catch {
      return; // another question follows
    }
  }
  working("");
}

/**
 * @param asked {engine, step, held} of a link; else what the model says
 * @param title of a model that a remedy changed; else its own
 */
async function open(text, name, asked = {}, title = "") {
  const turn = ++state.turn;
  showTrouble("");
  working(`Reading ${name} …`);
  state.doctor.cancel();
  const opened = await state.doctor.open(text, name);
  if (turn !== state.turn) return;
  if (!opened.ok) return void showTrouble(`${name} was not read`, opened.problems);
  const base = await state.doctor.run(opened.frame).catch(() => ""); // another model follows
  if (turn !== state.turn) return;
  if (base === "") return void showTrouble(`${name} cannot be run`);
  const { imported } = opened;
  Object.assign(state, { model: { text, name, isScene: imported === null, opened },
    base: JSON.parse(base), diagnosis: null });
  at("engine").value = asked.engine ?? engineOf[imported?.integrator] ?? "mujoco";
  at("held").value = String(asked.held ?? 0);
  setStep(asked.step ?? (imported?.timestep > 0 ? imported.timestep : opened.frame));
  at("patient").textContent = title !== "" ? title
    : imported === null ? `${opened.title || opened.name} (${name})`
      : `${opened.name} (${name}): ${imported.came_in.join("; ")}`;
  document.title = `${opened.name}: its step · substep`;
  document.body.classList.add("open");
  at("consultation").hidden = false;
  at("details").model = imported;
  run();
  await ask();
}

async function openFile(file) {
  if (!file) return;
  try {
    await open(await textOf(file), file.name);
  } catch (error) {
    showTrouble(`${file.name} was not read`, [{ pointer: "", message: error.message }]);
  }
}

async function openAddress() {
  if (location.hash.length < 2) return;
  const { model, asked, problems } = await readFragment(location.hash);
  if (asked.engine && ![...at("engine").options].some(({ value }) => value === asked.engine)) {
    problems.push({ pointer: "engine", message: `none is called ${asked.engine}` });
    delete asked.engine;
  }
  if (model) await open(model.text, model.name, asked);
  if (problems.length > 0) showTrouble("Parts of the link were not read", problems);
}

function save(name, data, type) {
  const href = URL.createObjectURL(new Blob([data], { type }));
  Object.assign(document.createElement("a"), { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), 60000);
  at("shared").textContent = `${name} was saved to Downloads`;
}

const link = async () => {
  const fragment = await writeFragment(state.model, question());
  return { address: `${location.href.replace(/#.*/, "")}#${fragment}`,
    isWhole: /&(scene|model)64=/.test(fragment) };
};

async function copyText(text, isWhole, what) {
  const done = await copy(text);
  at("shared").textContent = !done ? "The browser does not permit copying here"
    : isWhole ? `${what} copied` : `${what} copied, but the model is too large for it: send its file as well`;
}

/** Calls of the controls. */
const clicked = {
  choose() {
    const chooser = Object.assign(document.createElement("input"),
      { type: "file", accept: ".json,.xml,.mjcf,.urdf,application/json,text/xml" });
    chooser.addEventListener("change", () => openFile(chooser.files[0]));
    chooser.click();
  },
  below: () => changeStep(0.9 * state.diagnosis.largest_step),
  above: () => changeStep(1.1 * state.diagnosis.largest_step),
  again() {
    state.lab?.reset();
    state.lab?.play();
  },
  async "copy-link"() {
    const { address, isWhole } = await link();
    await copyText(address, isWhole, "Link");
  },
  async "copy-badge"() {
    const { address, isWhole } = await link();
    await copyText(badgeMarkdown(state.badge, address, state.diagnosis), isWhole, "Badge");
  },
  "save-badge": () => save(`${state.diagnosis.scene}-step.svg`, state.badge, "image/svg+xml"),
  "save-html": () => save(`${state.diagnosis.scene}-step.html`, state.html, "text/html"),
  "save-json"() {
    save(`${state.diagnosis.scene}-step.json`, `${JSON.stringify(state.diagnosis, null, 2)}\n`,
      "application/json");
  },
};

const timers = new Map();

/** Calls a function once no further call was made for a while. @param delay [ms]. */
function later(call, delay) {
  clearTimeout(timers.get(call));
  timers.set(call, setTimeout(call, delay));
}

function askLater() {
  if (state.model) working(reading);
  later(ask, settling); // a key may be held down
}

function changeStep(step) {
  setStep(step);
  later(run, 0);
  askLater();
}

function listen() {
  for (const [id, call] of Object.entries(clicked)) at(id).addEventListener("click", call);
  const fromSlider = () => shortest * 10 ** (at("step").value / perDecade);
  at("step").addEventListener("input", () => {
    setStep(fromSlider());
    later(run, settling);
  });
  at("step").addEventListener("change", askLater);
  at("exact").addEventListener("change", () => {
    const step = at("exact").valueAsNumber / 1e3;
    changeStep(Number.isFinite(step) ? step : state.step);
  });
  at("engine").addEventListener("change", askLater);
  at("held").addEventListener("change", () => {
    const held = Math.round(at("held").valueAsNumber);
    at("held").value = String(held >= 0 && held <= 1000 ? held : 0);
    askLater();
  });
  at("question").addEventListener("submit", (event) => event.preventDefault());
  // Before the laboratory, which would run a file that is dropped on it.
  const over = (event) => {
    event.preventDefault();
    event.stopPropagation();
    document.body.classList.toggle("dragged", event.type === "dragover");
    if (event.type === "drop") openFile(event.dataTransfer?.files[0]);
  };
  for (const type of ["dragover", "dragleave", "drop"]) window.addEventListener(type, over, { capture: true });
  window.addEventListener("hashchange", openAddress);
}

async function start() {
  for (const [name, { title, file, text }] of Object.entries(examples)) {
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: title });
    button.dataset.example = name;
    button.addEventListener("click", () => open(text, file));
    document.querySelector(".examples").append(button);
  }
  working("Loading …");
  try {
    state.doctor = await createDoctor((share) => working(`Loading: ${digits(100 * share, 2)} %`));
    window.doctor = state.doctor;
    at("engine").replaceChildren(
      ...(await state.doctor.engines()).map(({ name, title }) => new Option(title, name)));
  } catch (error) {
    return showTrouble("The doctor could not be loaded", [{ pointer: "", message: error.message }]);
  }
  working("");
  listen();
  await openAddress();
}

start();
keepOffline();
