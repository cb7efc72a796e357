// The two laboratories of article.html, and the text about their runs.
import { createSubstep } from "../substep.mjs";

const open = (id, mode) => createSubstep(document.getElementById(id), {
  scene: "swinging_box",
  settings: { mode, panels: "off" },
});
const [none, adaptive] = await Promise.all([open("none", "none"), open("adaptive", "adaptive")]);
const verdict = document.querySelector("#verdict");
const steps = document.querySelector("#steps");
none.on("verdict", (text) => {
  verdict.textContent = text === "holds" ? "It holds so far." : `It ${text}.`;
});
adaptive.on("frame", (report) => {
  steps.textContent = `Adaptive: ${report.substeps} sub-steps in this frame.`;
});
document.querySelector("#together").addEventListener("click", () => {
  for (const lab of [none, adaptive]) {
    lab.reset();
    lab.play();
  }
});
window.laboratories = { none, adaptive };
