// The page of the laboratory: it fills the window, the address holds the experiment, and what was
// loaded once works without a network.
import { keepOffline } from "./offline.mjs";
import { createSubstep } from "./substep.mjs";

const laboratory = document.querySelector("#laboratory");

try {
  window.substep = await createSubstep(laboratory, { address: true, wholePage: true });
  window.dispatchEvent(new Event("substep-ready"));
  // The keys work at once: where nothing else has the keyboard, the canvas takes it.
  window.addEventListener("keydown", (event) => {
    if (document.activeElement !== document.body || event.key === "Tab") return;
    const canvas = laboratory.querySelector("canvas");
    canvas.focus({ preventScroll: true });
    canvas.dispatchEvent(new KeyboardEvent(event.type, event));
  });
} catch {
  // It says itself, in its place, why it did not start.
}
keepOffline();
