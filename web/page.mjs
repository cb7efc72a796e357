// The page: its canvas, its address, its twin in HTML, and window.substep.
import { listen } from "./input.mjs";
import { start } from "./runtime.mjs";

const canvas = document.querySelector("#view");
const overlay = document.querySelector("#overlay");
const message = document.querySelector("#message");
const bar = document.querySelector("#progress");

function say(title, text, working = false) {
  overlay.hidden = false;
  overlay.querySelector("h1").textContent = title;
  message.textContent = text;
  bar.hidden = !working;
}

function missing() {
  if (typeof WebAssembly !== "object") return "WebAssembly";
  if (!document.createElement("canvas").getContext("webgl2")) return "WebGL 2";
  return "";
}

/** The drawing buffer has as many pixels as the screen shows. @returns whether it changed */
function fit(wasm) {
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
}

/** What the canvas shows, for those who do not see it. Told at most once a second. */
function makeTwin(report) {
  const fields = Object.fromEntries(
    [...document.querySelectorAll("#twin [data-field]")].map((e) => [e.dataset.field, e]));
  const live = document.querySelector("#announcement");
  let said = "";
  return () => {
    const r = report();
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
      if (fields[name] && fields[name].textContent !== value) fields[name].textContent = value;
    }
    // Read out only what a person waits for, not every number that moves.
    const words = `${r.title}, ${r.mode}, ${state}, ${r.verdict}`;
    if (words !== said) live.textContent = said = words;
  };
}

/** @param wake called with every call that may change what is to be seen */
function makeApi(wasm, wake) {
  const parse = (text) => JSON.parse(text);
  const calls = {
    /** A shipped scene's name, a scene as JSON text, or as an object. */
    load: (scene, from = "the scene") =>
      parse(wasm.load(typeof scene === "string" ? scene : JSON.stringify(scene), from)),
    /** Settings by name: {solver, mode, alpha, n, ...}. */
    set: (settings) => parse(wasm.set(JSON.stringify(settings))),
    /** Frames at once, without waiting for the clock. */
    step: (frames = 1) => {
      wasm.step(frames);
      return parse(wasm.report());
    },
    reset: () => wasm.reset(),
    play: () => wasm.play(1),
    pause: () => wasm.play(0),
  };
  for (const [name, call] of Object.entries(calls)) {
    calls[name] = (...args) => {
      wake();
      return call(...args);
    };
  }
  return {
    ...calls,
    report: () => parse(wasm.report()),
    hash: () => wasm.hash(),
    scenes: () => parse(wasm.scenes()),
  };
}

async function openFile(file, api) {
  if (!file) return;
  api.load(await file.text(), file.name);
  canvas.focus({ preventScroll: true });
}

async function main() {
  const what = missing();
  if (what) {
    say("This browser cannot show substep",
      `It needs ${what}, which is missing or switched off here. A current Firefox, Chrome, Edge or ` +
      "Safari has it; on some machines graphics acceleration must be on.");
    return;
  }
  const wasm = await start(canvas, (share) => { bar.value = share; });

  // A run that rests and a page that nobody touches need no drawing: pictures are drawn while it
  // plays and for a while after every event, until all that moves has come to rest.
  let awakeUntil = 0;
  const wake = () => { awakeUntil = performance.now() + 1500; };
  wake();
  const api = makeApi(wasm, wake);

  wasm.reducedMotion(matchMedia("(prefers-reduced-motion: reduce)").matches ? 1 : 0);
  if (matchMedia("(prefers-color-scheme: light)").matches) api.set({ theme: "light" });
  api.play();
  let fragment = location.hash;
  if (fragment.length > 1) wasm.openLink(fragment.slice(1));
  window.addEventListener("hashchange", () => {
    if (location.hash !== fragment) {
      wasm.openLink(location.hash.slice(1));
      wake();
    }
    fragment = location.hash;
  });

  listen(canvas, wasm, wake);
  window.addEventListener("dragover", (event) => event.preventDefault());
  window.addEventListener("drop", (event) => {
    event.preventDefault();
    openFile(event.dataTransfer?.files[0], api);
  });

  let lost = false;
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    lost = true;
    wasm.contextLost();
    say("The graphics context was lost", "The system took the graphics away, perhaps to save " +
      "memory. The picture comes back by itself when it is given again; the run waits.");
  });
  canvas.addEventListener("webglcontextrestored", () => {
    const error = wasm.contextRestored();
    if (error) {
      say("The graphics did not come back", `${error} Reloading the page helps.`);
      return;
    }
    lost = false;
    overlay.hidden = true;
    wake();
  });

  const tellTwin = makeTwin(api.report);
  let before = performance.now();
  let told = -Infinity;
  const draw = (now) => {
    requestAnimationFrame(draw);
    const dt = Math.max(0, (now - before) / 1000);
    before = now;
    if (lost) return;
    if (fit(wasm)) wake();
    if (!wasm.playing() && now > awakeUntil) return;
    wasm.frame(dt);
    canvas.style.cursor = wasm.cursor() === 2 ? "text" : "default";
    const link = wasm.takeLink();
    if (link) {
      fragment = `#${link}`;
      history.replaceState(null, "", fragment);
    }
    if (now - told > 1000) {
      told = now;
      tellTwin();
    }
  };
  fit(wasm);
  wasm.frame(0);
  overlay.hidden = true;
  requestAnimationFrame(draw);
  window.substep = api;
  window.dispatchEvent(new Event("substep-ready"));
}

main().catch((error) => {
  console.error(error);
  say("substep did not start", String(error?.message ?? error));
});
