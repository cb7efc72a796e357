// Measures the cost of the page: node tests/web/measure.mjs [FOLDER] [minutes of memory, 0]
// Frames a second of an empty page and pictures a second of this one, the main thread's time of a
// picture without physics with 200 s of plots, a sweep beside the run, the time until the chart of
// each shipped scene is on the screen, and memory over time.
import { call, drawn, open, openPage } from "./browser.mjs";

const minutes = Number(process.argv[3] ?? 0);
const session = await open();

/** Pictures a second, or frames if the page has no laboratory. */
const frames = (page, seconds) => page.evaluate(async (s) => {
  const pictures = document.querySelector("canvas")?.pictures;
  const start = performance.now();
  const before = pictures?.shown;
  let count = 0;
  while (performance.now() - start < 1000 * s) {
    await new Promise(requestAnimationFrame);
    ++count;
  }
  return 1000 * (pictures ? pictures.shown - before : count) / (performance.now() - start);
}, seconds);

async function empty() {
  const page = await session.browser.newPage();
  await page.goto("about:blank");
  const rate = await frames(page, 3);
  await page.close();
  return rate;
}

/** Times of the callbacks that start a picture, including the panels of its frame [ms]. */
const patch = `
window.frameTimes = [];
let begun = false;
const { fenceSync } = WebGL2RenderingContext.prototype; // the last call of such a callback
WebGL2RenderingContext.prototype.fenceSync = function (...given) {
  begun = true;
  return fenceSync.apply(this, given);
};
const later = window.setTimeout;
window.setTimeout = (run, ...rest) => later.call(window, () => {
  const start = performance.now();
  begun = false;
  run();
  if (begun) window.frameTimes.push(performance.now() - start);
}, ...rest);`;

const middle = (list, share = 0.5) => [...list].sort((a, b) => a - b)[Math.floor(share * list.length)];

console.log(`empty page: ${(await empty()).toFixed(1)} frames/s`);
for (const scene of ["swinging_box", "bridge", "heavy_stack"]) {
  const page = await openPage(session, { fragment: `scene=${scene}`, before: patch });
  await page.waitForFunction(() => window.substep);
  await page.waitForTimeout(4000); // until the quality of the picture has settled
  const rate = await frames(page, 6);
  const report = await call(page, "report");
  console.log(`${scene}: ${rate.toFixed(1)} pictures/s, ${report.milliseconds.toFixed(2)} ms to simulate one`);
  if (scene === "swinging_box") {
    await call(page, "pause");
    await call(page, "step", 12000); // 200 s
    // At rest, with events that keep it drawing: no physics, all plots.
    await page.evaluate(() => { window.frameTimes.length = 0; });
    for (let i = 0; i < 60; ++i) {
      await page.mouse.move(1100, 100 + i);
      await drawn(page);
    }
    const times = await page.evaluate(() => window.frameTimes);
    console.log(`200 s of plots, without physics: ${middle(times).toFixed(2)} ms per frame, ` +
      `95 % below ${middle(times, 0.95).toFixed(2)} ms, ${times.length} frames`);
    await call(page, "set", { mode: "adaptive", panel: "accuracy" });
    await call(page, "reset");
    await call(page, "play");
    await page.waitForTimeout(2000);
    const without = await frames(page, 6);
    await call(page, "set", { accuracy: "run" });
    const beside = await frames(page, 6);
    const asked = performance.now();
    await call(page, "set", { accuracy: "cancel" });
    const waited = performance.now() - asked;
    console.log(`a sweep beside it: ${beside.toFixed(1)} of ${without.toFixed(1)} pictures/s; ` +
      `cancelled ${waited.toFixed(0)} ms after the request`);
  }
  await page.context().close();
}

/** Time from opening the panel to its first picture, while the scene runs [ms]. */
const chart = (page) => page.evaluate(async () => {
  const { pictures } = document.querySelector("canvas");
  const start = performance.now();
  window.substep.set({ panel: "accuracy" });
  const { begun } = pictures;
  while (pictures.shown <= begun) await new Promise(requestAnimationFrame);
  return performance.now() - start;
});

{
  const page = await openPage(session);
  const times = [];
  for (const { name } of await call(page, "scenes")) {
    if (name.startsWith("exam_")) continue; // not shipped with a sweep
    await call(page, "set", { scene: name, panel: "plots" });
    await call(page, "play");
    await page.waitForTimeout(500);
    times.push([await chart(page), name]);
    const labels = (await call(page, "widgets")).map((w) => w.label);
    if (!labels.includes("Run again")) console.log(`${name}: no chart`);
  }
  times.sort((a, b) => b[0] - a[0]);
  console.log(`the chart of ${times.length} scenes: half of them within ` +
    `${times[Math.floor(times.length / 2)][0].toFixed(0)} ms, slowest ` +
    times.slice(0, 3).map(([ms, name]) => `${name} ${ms.toFixed(0)} ms`).join(", "));
  await page.context().close();
}

if (minutes > 0) {
  const page = await openPage(session);
  const scenes = (await call(page, "scenes")).map((s) => s.name);
  console.log("minute  scene                heap used MB  heap MB  JS MB");
  for (let i = 0; i <= 2 * minutes; ++i) {
    const scene = scenes[i % scenes.length];
    await call(page, "set", { scene });
    await call(page, "play");
    await page.waitForTimeout(30000);
    const { used, heap } = await call(page, "memory");
    const js = await page.evaluate(() => performance.memory?.usedJSHeapSize ?? 0);
    console.log(`${(i / 2).toFixed(1).padStart(6)}  ${scene.padEnd(20)} ${(used / 1e6).toFixed(2).padStart(12)}` +
      ` ${(heap / 1e6).toFixed(1).padStart(8)} ${(js / 1e6).toFixed(1).padStart(6)}`);
  }
}
await session.close();
