// Loads the WebAssembly with its progress told, and wraps what it exports.

const files = ["substep.wasm", "substep.data"];

/** Fetches a file of this folder, telling how many of its bytes are there. */
async function fetchBytes(name, tell) {
  const response = await fetch(new URL(name, import.meta.url));
  if (!response.ok) throw new Error(`${name}: ${response.status} ${response.statusText}`);
  // With compression the length is that of the packed bytes: the bar then only moves.
  const total = Number(response.headers.get("content-length")) || 0;
  const reader = response.body.getReader();
  const parts = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    size += value.length;
    tell(total ? Math.min(1, size / total) : 0.5);
  }
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes.buffer;
}

/**
 * Loads the application and opens it on a canvas.
 * @param {HTMLCanvasElement} canvas with an id
 * @param {(share: number) => void} progress 0..1
 * @returns the module with its functions wrapped: see web/README.md
 */
export async function start(canvas, progress) {
  const shares = [0, 0];
  const [wasmBinary, data] = await Promise.all(files.map((name, i) => fetchBytes(name, (share) => {
    shares[i] = share;
    progress(0.9 * shares[0] + 0.1 * shares[1]);
  })));
  const { default: createSubstep } = await import("./substep.js");
  const module = await createSubstep({
    wasmBinary,
    canvas,
    getPreloadedPackage: () => data,
    print: (text) => console.log(text),
    printErr: (text) => console.warn(text),
  });
  const call = (name, result, types = []) => module.cwrap(`substep_${name}`, result, types);
  const text = "string";
  const number = "number";
  const wasm = {
    start: call("start", text, [text]),
    contextLost: call("context_lost", null),
    contextRestored: call("context_restored", text),
    resize: call("resize", null, [number, number, number]),
    frame: call("frame", null, [number]),
    cursor: call("cursor", number),
    takeLink: call("take_link", text),
    pointer: call("pointer", null, [number, number, number]),
    pointerGone: call("pointer_gone", null),
    button: call("button", null, [number, number, number]),
    wheel: call("wheel", null, [number, number]),
    pinch: call("pinch", null, [number, number, number]),
    key: call("key", number, [text, number, number, number, number, number]),
    text: call("text", null, [text]),
    focus: call("focus", null, [number]),
    reducedMotion: call("reduced_motion", null, [number]),
    load: call("load", text, [text, text]),
    set: call("set", text, [text]),
    step: call("step", null, [number]),
    play: call("play", null, [number]),
    reset: call("reset", null),
    openLink: call("open_link", null, [text]),
    playing: call("playing", number),
    hash: call("hash", text),
    report: call("report", text),
    scenes: call("scenes", text),
  };
  const error = wasm.start(`#${canvas.id}`);
  if (error) throw new Error(error);
  return wasm;
}
