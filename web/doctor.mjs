// The step doctor without a page: a second instance of the program, in a worker, so that whoever
// asks stays responsive. See README.md.
import { isObject, isText, largest, mustBe, tooLong, wrong } from "./answers.mjs";
import { loadEngine } from "./loader.mjs";

const parse = (text) => JSON.parse(text);
const cancelled = "it was cancelled";

/**
 * @param progress called with 0..1 while the program is fetched
 * @returns a promise of the doctor; its calls return promises. `open` and `diagnose` resolve to
 *   {ok: false, problems} on failure, the others reject.
 */
export async function createDoctor(progress = () => {}) {
  const { compiled, data } = await loadEngine(progress);
  const pending = new Map(); // of calls: {done, fail}
  let last = 0;
  let worker = null;
  let removed = false;
  let opened = null; // the last [text, name] that could be read

  function send(message) {
    const id = ++last;
    return new Promise((done, fail) => {
      pending.set(id, { done, fail });
      worker.postMessage({ id, ...message });
    });
  }

  function failAll(reason) {
    for (const { fail } of pending.values()) fail(new Error(reason));
    pending.clear();
  }

  async function start() {
    worker = new Worker(new URL("doctor_worker.mjs", import.meta.url), { type: "module" });
    worker.addEventListener("message", ({ data: { id, result, failure } }) => {
      const call = pending.get(id);
      pending.delete(id);
      if (failure === undefined) call?.done(result);
      else call?.fail(new Error(failure));
    });
    worker.addEventListener("error", (event) => {
      event.preventDefault();
      failAll(event.message || "the worker could not be started");
    });
    await send({ engine: { compiled, data } });
    if (opened) await send({ name: "doctorOpen", args: opened });
  }

  /** Ends the worker and starts another, which opens the same model. */
  function restart(reason) {
    worker.terminate();
    failAll(reason);
    ready = start();
    ready.catch(() => {}); // the next call reports it
  }

  let ready = start();
  await ready;

  async function ask(name, ...args) {
    if (removed) throw new Error("this doctor was removed: createDoctor opens a new one");
    await ready;
    try {
      return await send({ name, args });
    } catch (error) {
      // After a trap the module is in an inconsistent state.
      if (/^the doctor stopped/.test(error.message)) restart(error.message);
      throw error;
    }
  }

  /** The answer, or {ok: false, problems}. */
  const answering = (call) => async (...args) => {
    try {
      return await call(...args);
    } catch (error) {
      return wrong("", error.message);
    }
  };

  return {
    /**
     * Opens a scene (an object, or JSON text) or the text of a model in MJCF, URDF or SLRBS.
     * @param name of its file, in messages
     */
    open: answering(async (model, name = "model") => {
      if (!isText(model) && !isObject(model)) return wrong("model", mustBe("text or an object", model));
      const text = isObject(model) ? JSON.stringify(model) : model;
      if (text.length > largest) return tooLong("model");
      const given = [text, String(name).slice(0, 200)];
      const answer = parse(await ask("doctorOpen", ...given));
      if (answer.ok) opened = given;
      return answer;
    }),
    /** @param question {engine, step, held, seconds, runs}, all optional */
    diagnose: answering(async (question = {}) => {
      if (!isObject(question)) return wrong("question", mustBe("an object", question));
      return parse(await ask("doctorDiagnose", JSON.stringify(question)));
    }),
    /** The scene, as the text of a file. */
    scene: () => ask("doctorScene"),
    /** The scene of the run with a step after the doctor's shake, as text. @param step [s] */
    run: (step) => ask("doctorRun", step),
    /** The scene that a remedy of the last diagnosis makes; "" if it changes no model. */
    remedied: (index) => ask("doctorRemedied", index),
    /** The last diagnosis as a page, and as a picture in SVG for a README. */
    html: () => ask("doctorHtml"),
    badge: () => ask("doctorBadge"),
    /** Names and titles of the engines. */
    engines: async () => parse(await ask("doctorEngines")),
    /** Ends what is being computed; the model stays open. */
    cancel() { if (!removed && pending.size > 0) restart(cancelled); },
    remove() {
      removed = true;
      worker.terminate();
      failAll("this doctor was removed");
    },
  };
}
