// The worker of doctor.mjs. The first message is the compiled program and its data; each of the
// others is a call, and is answered with its result or its failure.
import createModule from "./engine.js";
import { makeDoctorEngine } from "./loader.mjs";

let wasm = null;

async function answer({ name, args, engine }) {
  if (engine) wasm = await makeDoctorEngine({ ...engine, create: createModule });
  return engine ? "" : wasm[name](...args);
}

self.addEventListener("message", async ({ data }) => {
  try {
    self.postMessage({ id: data.id, result: await answer(data) });
  } catch (error) {
    self.postMessage({ id: data.id, failure: wasm?.stopped || String(error?.message ?? error) });
  }
});
