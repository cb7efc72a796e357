// Loads the WebAssembly and its data, reports progress, and wraps the exports.
import { sizes } from "./version.mjs";

/** An incomplete download; a retry may succeed. */
export class LoadError extends Error {}

/** Starts to fetch a file of this folder. @param tell called with the bytes of each piece */
async function fetchFile(name, type, tell) {
  let response;
  try {
    response = await fetch(new URL(name, import.meta.url));
  } catch (error) {
    throw new LoadError(`${name} could not be fetched: ${error.message}`);
  }
  if (!response.ok) throw new LoadError(`${name}: ${response.status} ${response.statusText}`);
  const counted = response.body.pipeThrough(new TransformStream({
    transform(piece, out) {
      tell(piece.length);
      out.enqueue(piece);
    },
  }));
  return new Response(counted, { headers: { "Content-Type": type } });
}

let attempts = 0;
let engine = null; // fetched and compiled once for all instances on a page
const watchers = new Set();

async function fetchEngine() {
  const total = sizes["engine.wasm"] + sizes["engine.data"];
  let done = 0;
  const tell = (bytes) => {
    done += bytes;
    for (const watcher of watchers) watcher(Math.min(1, done / total));
  };
  const files = [
    fetchFile("engine.wasm", "application/wasm", tell).then(WebAssembly.compileStreaming),
    fetchFile("engine.data", "application/octet-stream", tell).then((file) => file.arrayBuffer()),
    // Browsers cache a failed import: a retry needs another address.
    import(attempts++ ? `./engine.js?${attempts}` : "./engine.js"),
  ];
  try {
    const [compiled, data, script] = await Promise.all(files);
    return { compiled, data, create: script.default };
  } catch (error) {
    if (error instanceof LoadError) throw error;
    throw new LoadError(`the download was interrupted: ${error.message}`);
  }
}

/** @param progress called with 0..1 */
export async function loadEngine(progress) {
  watchers.add(progress);
  try {
    engine ??= fetchEngine();
    return await engine;
  } catch (error) {
    engine = null;
    throw error;
  } finally {
    watchers.delete(progress);
  }
}

// Results and parameters of the exports: v nothing, n number, s text.
const exported = {
  is_software: "ns", start: "snsn", context_lost: "v", context_restored: "s", resize: "vnnn", frame: "vnn", deferred: "n", present: "nn", cursor: "n",
  pointer: "vnnn", pointer_gone: "v", button: "vnnn", wheel: "vnn", pinching: "vn", pinch: "vnnn",
  key: "nsnnnnn", text: "vs", focus: "vn", pasted: "vs", reduced_motion: "vn",
  open: "ss", open_text: "sss", set: "ss", step: "vn", substep: "v", go_to: "vn", play: "vn", busy: "n", reset: "v",
  open_link: "ss", read: "vs", read_some: "n", open_read: "ss", open_read_link: "ss", start_opened: "v",
  introduce: "v", tour: "s", tour_in_page: "vn", dark: "n",
  link: "s", command: "s", own_scene: "s", saved_scene: "s", scene_text: "s", edit_text: "ss", settings: "s", history: "s",
  trouble: "vsss", tell: "vs", recording: "vn", hash: "s", report: "s", scenes: "s",
  widgets: "s", memory: "s",
};

// Of web/doctor.cpp: they need no application.
const exportedByDoctor = {
  doctor_open: "sss", doctor_diagnose: "ss", doctor_scene: "s", doctor_run: "sn", doctor_remedied: "sn", doctor_html: "s",
  doctor_badge: "s", doctor_engines: "s",
};

const encoder = new TextEncoder();

/**
 * A function of the module. Texts go through the heap: a file does not fit on the stack.
 * @param life {stopped}: why calls are disabled, or ""; set when a call traps, which leaves the
 *   module in an inconsistent state
 */
function wrap(module, name, signature, life) {
  const [result, ...types] = signature;
  const call = module[`_substep_${name}`];
  return (...args) => {
    if (life.stopped) throw new Error(life.stopped);
    const texts = [];
    const raw = (type, i) => {
      if (type === "n") return Number(args[i]);
      const bytes = encoder.encode(String(args[i])); // much faster than the module's encoder
      const at = module._malloc(bytes.length + 1);
      if (at === 0) throw new Error(`not enough memory for a text of ${bytes.length} bytes`);
      texts.push(at);
      module.HEAPU8.set(bytes, at);
      module.HEAPU8[at + bytes.length] = 0;
      return at;
    };
    try {
      const value = call(...types.map(raw));
      return result === "s" ? module.UTF8ToString(value) : value;
    } catch (error) {
      // Out of memory or out of bounds, or of the stack.
      if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) life.stop(error);
      throw error;
    } finally {
      if (!life.stopped) texts.forEach((at) => module._free(at));
    }
  };
}

/** Releases a canvas's context at once: browsers limit their number. */
export function loseContext(canvas) {
  canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context")?.loseContext();
}

const camel = (name) => name.replace(/_(.)/g, (_, letter) => letter.toUpperCase());

/** A module of its own. @param more of its options */
const instantiate = (engine, more) => engine.create({
  ...more,
  instantiateWasm(imports, done) {
    WebAssembly.instantiate(engine.compiled, imports).then((instance) => done(instance));
    return {};
  },
  // Read once by each instance, which may take ownership.
  getPreloadedPackage: () => engine.data.slice(0),
  print: (text) => console.log(text),
  printErr: (text) => console.warn(text),
});

/** Adds the exports by their names in camel case. */
function addExports(wasm, module, signatures) {
  for (const [name, signature] of Object.entries(signatures)) {
    wasm[camel(name)] = wrap(module, name, signature, wasm);
  }
}

/** The exports of a module for the step doctor, without an application. */
export async function makeDoctorEngine(engine) {
  const wasm = { stopped: "" };
  wasm.stop = (error) => { wasm.stopped = `the doctor stopped: ${error.message}`; };
  addExports(wasm, await instantiate(engine, {}), exportedByDoctor);
  return wasm;
}

/**
 * A separate application for a canvas.
 * @param engine the result of loadEngine
 * @param host services of the page for the application, see web/host.cpp
 * @param renderer name of the graphics renderer, or ""
 * @returns the exports by their names in camel case; run() starts it, once the host is complete,
 *   releaseGraphics() releases the context until takeGraphics(), close() permanently
 */
export async function makeEngine(engine, canvas, host, renderer) {
  const module = await instantiate(engine, { host, canvas });
  const wasm = { stopped: "" };
  wasm.stop = (error) => {
    wasm.stopped = `the laboratory stopped: ${error.message}`;
    host.stopped?.();
  };
  addExports(wasm, module, exported);
  let losing = null; // WEBGL_lose_context: loses and restores a context
  wasm.run = (keeps) => {
    // With alpha, although all pixels are opaque: masking it out is slow in a software renderer.
    // Such a renderer may redraw parts of the canvas, which therefore keeps its pixels.
    const context = module.GL.createContext(canvas, {
      majorVersion: 2, minorVersion: 0, alpha: true, antialias: false, depth: false,
      preserveDrawingBuffer: wasm.isSoftware(renderer) !== 0,
    });
    if (!context) throw new Error("The browser provides no WebGL 2 context");
    losing = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
    const error = wasm.start(context, renderer, keeps ? 1 : 0);
    if (error) throw new Error(error);
  };
  wasm.canReleaseGraphics = () => losing !== null;
  wasm.releaseGraphics = () => {
    wasm.contextLost();
    losing.loseContext();
  };
  wasm.takeGraphics = () => losing.restoreContext();
  wasm.close = () => loseContext(canvas);
  return wasm;
}
