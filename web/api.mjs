// The API of a laboratory: window.substep, and the result of createSubstep, documented in
// README.md. Nothing throws: errors are returned, and the run continues.
import { isObject, isText, largest, makeGuards, messageOf, mustBe, optionOf, right, show, tooLong,
  wrong } from "./answers.mjs";

const longest = 100_000; // frames per call
const gone = "this laboratory was removed: createSubstep opens a new one";

const parse = (text) => JSON.parse(text);

function load(wasm, scene, from) {
  if (!isText(scene) && !isObject(scene)) {
    return wrong("scene", mustBe("the name of a scene, JSON text or an object", scene));
  }
  const name = typeof from === "string" ? from.slice(0, 200) : show(from);
  let text = scene;
  try {
    if (isObject(scene)) text = JSON.stringify(scene) ?? "";
  } catch (error) {
    return wrong("scene", messageOf(error));
  }
  if (text.length > largest) return tooLong("scene");
  return parse(text.includes("{") ? wasm.openText(text, name) : wasm.open(text));
}

function set(wasm, settings) {
  if (!isObject(settings)) return wrong("", mustBe("an object of settings", settings));
  const entries = Object.entries(settings); // a getter may return a different value the next time
  for (const [key, value] of entries) {
    if (!["string", "number", "boolean"].includes(typeof value)) {
      return wrong(key, mustBe("a string, a number, true or false", value));
    }
  }
  const text = JSON.stringify(Object.fromEntries(entries));
  return text.length > largest ? tooLong("") : parse(wasm.set(text));
}

/** Calls that change the run. */
function makeChanging(wasm, report) {
  const done = () => ({ ...right(), ...report() });
  return {
    load: (scene, from = "The scene") => load(wasm, scene, from),
    set: (settings) => set(wasm, settings),
    step(frames = 1) {
      if (!Number.isInteger(frames) || frames < 0 || frames > longest) {
        return wrong("frames", mustBe(`a whole number from 0 to ${longest}`, frames));
      }
      wasm.step(frames);
      return done();
    },
    substep() {
      wasm.substep();
      return done();
    },
    goTo(time) {
      if (!Number.isFinite(time) || time < 0) {
        return wrong("time", mustBe("a number of at least 0 (s)", time));
      }
      wasm.play(0);
      wasm.goTo(time);
      return done();
    },
    editText(text) {
      if (!isText(text)) return wrong("text", mustBe("a string without NUL", text));
      return text.length > largest ? tooLong("text") : parse(wasm.editText(text));
    },
    play() {
      wasm.play(1);
      return right();
    },
    pause() {
      wasm.play(0);
      return right();
    },
    reset() {
      wasm.reset();
      return right();
    },
  };
}

/** Read-only calls. */
const makeLooking = (wasm, report) => ({
  report,
  settings: () => parse(wasm.settings()),
  scenes: () => parse(wasm.scenes()),
  tour: () => parse(wasm.tour()),
  widgets: () => parse(wasm.widgets()),
  memory: () => parse(wasm.memory()),
  hash: () => wasm.hash(),
  command: () => wasm.command(),
  history: () => wasm.history(),
  saved: () => wasm.savedScene(),
  sceneText: () => parse(wasm.sceneText()),
});

/** Calls that return a promise, which may be rejected. */
const makePromised = (address, capture, report) => ({
  link: () => address.url(),
  screenshot(options) {
    const part = optionOf(options, "part", "window");
    if (part !== "window" && part !== "view") {
      throw new Error(`part: ${mustBe('"window" or "view"', part)}`);
    }
    const [x, y, width, height] = report().view;
    return capture.picture(part === "view" ? { x, y, width, height } : undefined);
  },
  record(options) {
    const seconds = optionOf(options, "seconds", 5);
    if (typeof seconds !== "number" || !(seconds > 0 && seconds <= 600)) {
      throw new Error(`seconds: ${mustBe("above 0 and at most 600 (s)", seconds)}`);
    }
    const video = capture.begin();
    if (!video) throw new Error("a video is already being recorded, or this browser cannot record");
    setTimeout(capture.end, 1000 * seconds);
    return video;
  },
});

/** Listeners to frames and verdicts. @param trouble why none can be added, or "" */
function makeListeners(report, trouble) {
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
  return {
    /** @returns a function that ends it; on failure it has the properties {ok, problems} */
    on(event, listener) {
      const known = typeof event === "string" && Object.hasOwn(listeners, event);
      const problem = trouble() || (known && typeof listener === "function" ? ""
        : `the event must be ${Object.keys(listeners).join(" or ")}, with a function`);
      if (problem) {
        console.error(`substep.on(${show(event)}): ${problem}`);
        return Object.assign(() => {}, wrong("", problem));
      }
      listeners[event].add(listener);
      return () => listeners[event].delete(listener);
    },
    /** Notifies the listeners after a drawn frame. */
    afterDraw() {
      if (listeners.frame.size + listeners.verdict.size === 0) return;
      const now = report();
      const run = `${now.scene} ${now.run}`;
      if (run !== last.run || now.frame !== last.frame) emit("frame", now);
      if (run !== last.run || now.verdict !== last.verdict) emit("verdict", now.verdict);
      last = { run, frame: now.frame, verdict: now.verdict };
    },
    close() { for (const set of Object.values(listeners)) set.clear(); },
  };
}

export function makeApi({ wasm, wake, address, capture, clock, frame }) {
  const report = () => parse(wasm.report());
  let removed = false;
  const trouble = () => (removed ? gone : wasm.stopped);
  const { answering, promising, telling } = makeGuards(trouble);
  const listeners = makeListeners(report, trouble);
  const waking = (call) => (...args) => {
    try {
      return call(...args);
    } finally {
      wake(); // afterwards: a call may take longer than the page stays active
    }
  };

  const calls = {
    on: listeners.on,
    openLink: telling(waking((link) => {
      if (!isText(link)) return wrong("link", mustBe("a string without NUL", link));
      if (link.length > largest) return tooLong("link");
      return address.open(link.includes("#") ? link.slice(link.indexOf("#")) : link);
    })),
    remove() {
      if (removed) return wrong("", gone);
      removed = true;
      listeners.close();
      clock.stop();
      address.stop();
      capture.close(gone);
      if (!wasm.stopped) wasm.close();
      frame.end();
      return right();
    },
  };
  const add = (guard, some) => {
    for (const [name, call] of Object.entries(some)) calls[name] = guard(call);
  };
  add((call) => answering(waking(call)), makeChanging(wasm, report));
  add(answering, makeLooking(wasm, report));
  add(promising, makePromised(address, capture, report));
  return { calls, afterDraw: listeners.afterDraw };
}
