// What programs may ask of a laboratory: window.substep, and what createSubstep gives. README.md
// says it for people. Nothing throws: what is wrong comes back, and what ran goes on.

const longest = 100_000; // frames of one call
const right = { ok: true, problems: [] };
const wrong = (pointer, message) => ({ ok: false, problems: [{ pointer, message }] });
const show = (value) => {
  try {
    return JSON.stringify(value) ?? String(value);
  } catch {
    return String(value);
  }
};
const isObject = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** A text without what would end it early on its way. */
const isText = (value) => typeof value === "string" && !value.includes("\0");

export function makeApi({ wasm, wake, address, capture, clock, frame }) {
  const parse = (text) => JSON.parse(text);
  const report = () => parse(wasm.report());
  const listeners = { frame: new Set(), verdict: new Set() };
  let last = { run: "", frame: -1, verdict: "" };

  function emit(event, value) {
    for (const listener of listeners[event]) {
      try {
        listener(value);
      } catch (error) {
        console.error(`substep: a listener of "${event}" failed`, error);
      }
    }
  }

  const changing = {
    load(scene, from = "The scene") {
      if (!isText(scene) && !isObject(scene)) {
        return wrong("scene", `${show(scene)} is no scene's name, JSON text or object`);
      }
      let text = scene;
      try {
        if (isObject(scene)) text = JSON.stringify(scene) ?? "";
      } catch (error) {
        return wrong("scene", error.message);
      }
      return parse(text.includes("{") ? wasm.openText(text, String(from)) : wasm.open(text));
    },
    set(settings) {
      if (!isObject(settings)) return wrong("", `${show(settings)} is not an object of settings`);
      for (const [key, value] of Object.entries(settings)) {
        if (!["string", "number", "boolean"].includes(typeof value)) {
          return wrong(key, `${show(value)} is not a text, a number, true or false`);
        }
      }
      return parse(wasm.set(JSON.stringify(settings)));
    },
    step(frames = 1) {
      if (!Number.isInteger(frames) || frames < 0 || frames > longest) {
        return wrong("frames", `${show(frames)} is not a whole number from 0 to ${longest}`);
      }
      wasm.step(frames);
      return { ...right, ...report() };
    },
    substep() {
      wasm.substep();
      return { ...right, ...report() };
    },
    goTo(time) {
      if (!Number.isFinite(time) || time < 0) return wrong("time", `${show(time)} is no time in s`);
      wasm.play(0);
      wasm.goTo(time);
      return { ...right, ...report() };
    },
    play() {
      wasm.play(1);
      return right;
    },
    pause() {
      wasm.play(0);
      return right;
    },
    reset() {
      wasm.reset();
      return right;
    },
    openLink(link) {
      if (!isText(link)) return Promise.resolve(wrong("link", `${show(link)} is not a text`));
      return address.open(link.includes("#") ? link.slice(link.indexOf("#")) : link);
    },
  };
  const calls = {
    report,
    settings: () => parse(wasm.settings()),
    scenes: () => parse(wasm.scenes()),
    widgets: () => parse(wasm.widgets()),
    memory: () => parse(wasm.memory()),
    hash: () => wasm.hash(),
    command: () => wasm.command(),
    link: () => address.url(),
    history: () => wasm.history(),
    saved: () => wasm.savedScene(),
    screenshot(options) {
      const { part = "window" } = options ?? {};
      if (part !== "window" && part !== "view") {
        return Promise.reject(new Error(`part: ${show(part)} is not "window" or "view"`));
      }
      const [x, y, width, height] = report().view;
      return capture.picture(part === "view" ? { x, y, width, height } : undefined);
    },
    record(options) {
      const { seconds = 5 } = options ?? {};
      if (!(seconds > 0 && seconds <= 600)) {
        return Promise.reject(new Error(`seconds: ${show(seconds)} is not above 0 and at most 600`));
      }
      const video = capture.begin();
      if (!video) {
        return Promise.reject(new Error("a video is being recorded, or this browser cannot"));
      }
      setTimeout(capture.end, 1000 * seconds);
      return video;
    },
    on(event, listener) {
      if (!Object.hasOwn(listeners, event) || typeof listener !== "function") {
        console.error(`substep.on(${show(event)}): events are ${Object.keys(listeners).join(", ")}` +
          ", each with a function");
        return () => {};
      }
      listeners[event].add(listener);
      return () => listeners[event].delete(listener);
    },
    remove() {
      clock.stop();
      address.stop();
      wasm.close();
      frame.end();
    },
  };
  for (const [name, call] of Object.entries(changing)) {
    calls[name] = (...args) => {
      wake();
      return call(...args);
    };
  }

  return {
    calls,
    /** Tells those who listen what the last picture shows. */
    afterDraw() {
      if (listeners.frame.size + listeners.verdict.size === 0) return;
      const now = report();
      const run = `${now.scene} ${now.run}`;
      if (run !== last.run || now.frame !== last.frame) emit("frame", now);
      if (run !== last.run || now.verdict !== last.verdict) emit("verdict", now.verdict);
      last = { run, frame: now.frame, verdict: now.verdict };
    },
  };
}
