// A laboratory in an element of any page: the module to import. See README.md.
import { makeAddress } from "./address.mjs";
import { makeApi } from "./api.mjs";
import { makeCapture } from "./capture.mjs";
import { Clock } from "./clock.mjs";
import { makeFiles } from "./files.mjs";
import { makeFrame } from "./frame.mjs";
import { listen } from "./input.mjs";
import { LoadError, loadEngine, loseContext, makeEngine } from "./loader.mjs";
import { optionError, problemsOf, readOptions } from "./options.mjs";
import { makeSceneReader } from "./scene_reader.mjs";
import { makeTour } from "./tour.mjs";
import { makeTwin } from "./twin.mjs";

// The smallest module with a SIMD instruction: a function that returns two times 0.
const VECTORS = new Uint8Array([
  0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, // magic, version
  1, 5, 1, 0x60, 0, 1, 0x7b, // a type: no parameters, a v128
  3, 2, 1, 0, // a function of that type
  10, 15, 1, 13, 0, 0x44, 0, 0, 0, 0, 0, 0, 0, 0, 0xfd, 20, 0x0b, // f64.const 0, f64x2.splat, end
]);

/**
 * What this browser has.
 * @returns {lacking, renderer}: the feature that is missing, or ""; the name of the graphics
 *   renderer, or "" if the browser hides it
 */
function inspect() {
  if (typeof WebAssembly !== "object") return { lacking: "WebAssembly" };
  if (!WebAssembly.validate(VECTORS)) return { lacking: "WebAssembly with SIMD" };
  const canvas = document.createElement("canvas");
  const gl = canvas.getContext("webgl2");
  if (!gl) return { lacking: "WebGL 2" };
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = names && gl.getParameter(names.UNMASKED_RENDERER_WEBGL);
  loseContext(canvas); // browsers limit their number
  return { lacking: "", renderer: renderer ?? "" };
}

/** Loads the program; on network errors retries until it succeeds or the user gives up. */
async function load(frame) {
  for (;;) {
    frame.say("substep", "Loading the laboratory", { working: true });
    try {
      return await loadEngine(frame.progress);
    } catch (error) {
      if (!(error instanceof LoadError)) throw error;
      console.error(error);
      await frame.ask("The laboratory could not be loaded", `${error.message}. Is there a network?`,
        "Try again");
    }
  }
}

/**
 * Opens a laboratory in an element, which it fills: give the element a size.
 * @param {HTMLElement} element
 * @param {object} options
 *   scene: name of a shipped scene, or a scene as object or JSON text
 *   settings: {mode, alpha, ..., theme, panels, tint, speed}
 *   link: an experiment as the fragment of an address, "scene=bridge&mode=none"
 *   play: whether it starts at once, true
 *   address: whether the page's address holds the experiment, false
 *   wholePage: whether wheel and touch always belong to the laboratory; otherwise (false) they
 *     scroll the page until the laboratory is clicked or tapped
 * @returns a promise of the API; rejected if an option is unknown or invalid, with a message that
 *   names it, or if the browser lacks a required feature
 */
export async function createSubstep(element, options) {
  if (!(element instanceof HTMLElement)) {
    throw new TypeError("createSubstep: the first argument must be an element of the page");
  }
  const chosen = readOptions(options);
  const frame = makeFrame(element, chosen.wholePage);
  const { lacking, renderer } = inspect();
  if (lacking) {
    frame.say("This browser cannot show substep", "It is a laboratory for stable constrained rigid " +
      `bodies. It needs ${lacking}, which is unavailable or switched off here. A current Firefox, ` +
      "Chrome, Edge or Safari has it; on some machines graphics acceleration must be on.",
    { pictured: true });
    throw new Error(`substep needs ${lacking}`);
  }
  try {
    return await open(frame, chosen, renderer);
  } catch (error) {
    console.error(error);
    frame.say("substep did not start", String(error?.message ?? error));
    throw error;
  }
}

/** After a trap: restarts the page with the previous scene. */
async function startAgain(frame, wasm, address) {
  console.error(wasm.stopped);
  const why = "The program ran out of memory, or has a defect. Other pages are not affected.";
  if (!frame.wholePage) return frame.say("The laboratory stopped", `${why} Reload the page.`);
  await frame.ask("The laboratory stopped", why, "Start again with the previous scene");
  address.goBefore();
}

async function open(frame, options, renderer) {
  const engine = await load(frame);
  const host = {}; // called by the application, see web/host.cpp
  const wasm = await makeEngine(engine, frame.canvas, host, renderer);
  const readScene = makeSceneReader(wasm);
  const files = makeFiles(frame, wasm, host, readScene);
  const address = makeAddress(wasm, host, readScene, options.address, frame.signal);
  const capture = makeCapture(frame, wasm, host, files.save);
  wasm.run(frame.wholePage);

  let api = null;
  let twin = null;
  let tour = null;
  const clock = new Clock(wasm, frame, (whole) => {
    capture.afterDraw();
    frame.paint(wasm.dark());
    if (whole) tour?.afterDraw(); // it shows the same time and N as the panels
    twin?.afterDraw();
    api?.afterDraw(); // last: a listener may remove the laboratory
  });
  const wake = () => clock.wake();
  host.changed = wake;
  host.stopped = () => startAgain(frame, wasm, address);

  wasm.reducedMotion(matchMedia("(prefers-reduced-motion: reduce)").matches ? 1 : 0);
  wasm.tourInPage(frame.tour ? 1 : 0);
  frame.fit(wasm);
  api = makeApi({ wasm, wake, address, capture, clock, frame });
  const { calls } = api;
  if (matchMedia("(prefers-color-scheme: light)").matches) calls.set({ theme: "light" });
  if (options.play) calls.play();
  const problems = [];
  if (options.scene !== undefined) problems.push(...problemsOf("scene", calls.load(options.scene)));
  if (options.settings !== undefined) problems.push(...problemsOf("settings", calls.set(options.settings)));
  if (options.link !== undefined) problems.push(...problemsOf("link", await calls.openLink(options.link)));
  if (problems.length > 0) {
    clock.stop();
    address.stop();
    capture.close("the laboratory did not start");
    frame.stop();
    wasm.close();
    throw optionError(problems);
  }
  if (!options.play) calls.pause();
  const linked = await address.start();
  if (frame.wholePage && !linked) wasm.introduce();
  if (frame.tour) tour = makeTour(frame, calls);
  twin = makeTwin(frame.twin, calls);

  listen(frame.canvas, wasm, wake, !frame.wholePage, frame.signal);
  if (clock.graphics.canDraw()) clock.draw(0);
  if (!clock.graphics.wasTaken()) frame.clear();
  return calls;
}
