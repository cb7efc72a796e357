// The page of the laboratory: it fills the window, the address holds the experiment, and it works
// without a network once loaded.
import { keepOffline } from "./offline.mjs";
import { createSubstep } from "./substep.mjs";

const laboratory = document.querySelector("#laboratory");

try {
  window.substep = await createSubstep(laboratory, { address: true, wholePage: true });
  window.dispatchEvent(new Event("substep-ready"));
  // Keys work at once: the canvas takes the focus unless another element has it.
  window.addEventListener("keydown", (event) => {
    if (document.activeElement !== document.body || event.key === "Tab") return;
    const canvas = laboratory.querySelector("canvas");
    canvas.focus({ preventScroll: true });
    canvas.dispatchEvent(new KeyboardEvent(event.type, event));
  });
} catch {
  // The failure is already shown in the laboratory's element.
}
keepOffline();
