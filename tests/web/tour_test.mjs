// The guided tour: HTML beside the canvas, with numbers to drag, tasks, and words that highlight
// plots: node tests/web/tour_test.mjs [FOLDER OF THE BUILT PAGE] [all]
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { all, call, click, drawn, leave, open, openPage, reports, save } from "./browser.mjs";

const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const steps = 8;

let session;
before(async () => { session = await open({ rate: 15 }); });
after(() => session?.close());

const tour = (page) => page.locator(".substep-tour");
const button = (page, name) => tour(page).getByRole("button", { name, exact: true });
const number = (page, name) => tour(page).getByRole("slider", { name, exact: true });
const canvasBox = (page) => page.locator(".substep-view").boundingBox();

/** Goes to a step, and waits until its text is shown. */
async function goTo(page, step) {
  await call(page, "set", { tour: step });
  await page.getByText(`Tour, ${step} of ${steps}`).waitFor();
  await drawn(page);
}

/** Runs ahead of the clock until the run answers. */
const reply = async (page, words) => {
  const said = tour(page).getByRole("status");
  await page.waitForFunction((w) => {
    const answered = new RegExp(w).test(document.querySelector(".substep-tour [role=status]").textContent);
    if (!answered) window.substep.step(10);
    return answered;
  }, words, { polling: 100, timeout: 90000 });
  return said.textContent();
};

/** Drags from the middle of an element. */
async function drag(page, element, dx) {
  const { x, y, width, height } = await element.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + dx / 2, y + height / 2);
  await page.mouse.move(x + width / 2 + dx, y + height / 2);
  await page.mouse.up();
}

async function findings(page) {
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" ")}`);
}

/** Checks that nothing is cut off, and that the canvas keeps at least half of the height or width. */
async function assertFits(page, width, height) {
  const box = await tour(page).boundingBox();
  const canvas = await canvasBox(page);
  assert.ok(box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height);
  assert.ok(canvas.width * canvas.height > 0.5 * width * height, "the canvas is too small");
  const beside = canvas.x >= box.x + box.width - 1 || canvas.y + canvas.height <= box.y + 1;
  assert.ok(beside, "the text covers the canvas");
  const cut = await tour(page).evaluate((e) => [...e.querySelectorAll("*")]
    .filter((part) => part.scrollWidth > part.clientWidth + 1 && part.clientWidth > 0)
    .map((part) => part.className));
  assert.deepEqual(cut, [], "cut off at the side");
}

// Both themes; beside the canvas and below it.
const displays = [[1280, 720, false], [390, 844, true]];
if (all) displays.push([1920, 1080, true]);
for (const [width, height, light] of displays) {
  test(`${width}x${height}, ${light ? "light" : "dark"}: every step fits and axe finds nothing`, async () => {
    const page = await openPage(session, { width, height, light, touch: width < 900 });
    await page.evaluate(axe);
    for (let step = 1; step <= steps; ++step) {
      await goTo(page, step);
      await assertFits(page, width, height);
      // By day on the desktop only: access_test.mjs has a step on a phone.
      if (all || width >= 900) assert.deepEqual(await findings(page), [], `step ${step}`);
      const labels = (await call(page, "widgets")).map((w) => w.label);
      assert.ok(!labels.includes("Next") && !labels.includes("Done"), "its card is in the canvas too");
      if (all) await save(page, `tour-${width}-${light ? "light" : "dark"}-${step}`);
    }
    await leave(page);
  });
}

test("the button in the canvas begins it; Next, Back and Done navigate it", async () => {
  const page = await openPage(session);
  assert.equal(await tour(page).isVisible(), false);
  await page.waitForFunction(() => window.substep.widgets().some((w) => w.label === "Tour"));
  await click(page, "Tour");
  await page.getByText(`Tour, 1 of ${steps}`).waitFor();
  assert.ok(await button(page, "Back").isDisabled());
  const wanted = [{ mode: "none" }, { mode: "const", n: "7" }, { mode: "capped" }, { mode: "adaptive" },
    { alpha: "0.1" }, { mode: "adaptive" }, { policy: "substep" }, { integrator: "leapfrog" }];
  for (const [i, settings] of wanted.entries()) {
    await page.getByText(`Tour, ${i + 1} of ${steps}`).waitFor();
    const now = Object.fromEntries((await call(page, "settings")).map((s) => [s.name, String(s.value)]));
    for (const [name, value] of Object.entries(settings)) assert.equal(now[name], value, `step ${i + 1}, ${name}`);
    assert.equal((await call(page, "report")).tour, i + 1);
    if (i + 1 < steps) await button(page, "Next").click();
  }
  await button(page, "Back").click();
  await page.getByText(`Tour, ${steps - 1} of ${steps}`).waitFor();
  await button(page, "Next").click();
  await button(page, "Done").click();
  await reports(page, "tour", 0);
  assert.equal(await tour(page).isVisible(), false);
  await leave(page);
});

test("the arrows beside a number go to the next value, by mouse and by finger", async () => {
  for (const touch of [false, true]) {
    const page = await openPage(session, touch ? { width: 390, height: 844, touch } : {});
    await goTo(page, 2);
    const n = async () => Number((await call(page, "settings")).find((s) => s.name === "n").value);
    const press = async (share) => {
      const box = await number(page, "Sub-steps per frame").boundingBox();
      const x = box.x + share * box.width;
      const y = box.y + 0.5 * box.height;
      if (touch) await page.touchscreen.tap(x, y);
      else await page.mouse.click(x, y);
    };
    assert.equal(await n(), 7);
    await press(0.9);
    assert.equal(await n(), 8);
    await press(0.5);
    assert.equal(await n(), 8, "the number itself is only dragged");
    await press(0.1);
    await press(0.1);
    assert.equal(await n(), 6);
    await leave(page);
  }
});

test("dragging a number changes the run, and the run answers the task", async () => {
  const page = await openPage(session);
  await goTo(page, 2);
  assert.match(await reply(page, "holds"), /^With 7 sub-steps it holds for 4 s\.$/);
  await drag(page, number(page, "Sub-steps per frame"), -12);
  const n = (await call(page, "settings")).find((s) => s.name === "n").value;
  assert.equal(String(n), "6");
  assert.ok((await call(page, "report")).time < 1, "the run did not start again");
  const said = await reply(page, "With 6 sub-steps the");
  const { verdict } = await call(page, "report");
  const failed = /fails at ([\d.]+) s/.exec(verdict);
  assert.ok(failed, verdict);
  assert.ok(said.endsWith(` at ${Number(failed[1]).toFixed(2)} s.`), said);
  assert.equal(await tour(page).locator(".substep-tour-done").count(), 1);
  await save(page, "tour-task-done");
  await drag(page, number(page, "Sub-steps per frame"), 20);
  assert.equal(await number(page, "Sub-steps per frame").textContent(), "8 sub-steps");
  await reply(page, "With 8 sub-steps it holds");
  assert.equal(await tour(page).locator(".substep-tour-done").count(), 0);
  await leave(page);
});

test("the keys of a slider change a number", async () => {
  const page = await openPage(session);
  await goTo(page, 5);
  const alpha = number(page, "Alpha");
  await alpha.focus();
  const value = () => alpha.getAttribute("aria-valuetext");
  for (const [key, wanted] of [["ArrowRight", "0.125"], ["ArrowUp", "0.16"], ["ArrowLeft", "0.125"],
    ["ArrowDown", "0.1"], ["PageDown", "0.04"], ["PageUp", "0.1"], ["End", "1"], ["ArrowRight", "1"],
    ["Home", "0.01"]]) {
    await page.keyboard.press(key);
    assert.equal(await value(), wanted, key);
    assert.equal((await call(page, "report")).alpha, Number(wanted), key);
  }
  assert.deepEqual(await alpha.evaluate((e) => ["valuenow", "valuemin", "valuemax"]
    .map((name) => Number(e.getAttribute(`aria-${name}`)))), [0.01, 0.01, 1]);
  await goTo(page, 6);
  await number(page, "Mass of the box").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await number(page, "Mass of the box").getAttribute("aria-valuetext"), "2,000 kg");
  assert.match(await page.evaluate(() => window.substep.link()), /load=2.*compare=/);
  await leave(page);
});

test("a number changed elsewhere is updated in the sentence", async () => {
  const page = await openPage(session);
  await goTo(page, 5);
  await call(page, "set", { alpha: 0.07 });
  await drawn(page);
  assert.equal(await number(page, "Alpha").textContent(), "0.07");
  await number(page, "Alpha").focus();
  await page.keyboard.press("ArrowRight"); // from between two stops to the next
  assert.equal((await call(page, "report")).alpha, 0.08);
  await goTo(page, 2);
  await call(page, "set", { n: 30 });
  await drawn(page);
  const n = number(page, "Sub-steps per frame");
  await n.focus();
  await page.keyboard.press("ArrowRight"); // beyond the last stop there is no next one
  assert.equal(await n.getAttribute("aria-valuetext"), "30 sub-steps");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await n.getAttribute("aria-valuetext"), "24 sub-steps");
  await leave(page);
});

test("references mark plots with a ring on hover and focus, and open the panel on a click", async () => {
  const page = await openPage(session);
  await goTo(page, 5);
  await page.waitForTimeout(300);
  const ring = page.locator(".substep-ring");
  assert.equal(await ring.isVisible(), false);
  await button(page, "the energy drift").hover();
  await drawn(page);
  const plot = (await call(page, "widgets")).find((w) => w.group === "plot" && w.label === "drift");
  const canvas = await canvasBox(page);
  const box = await ring.boundingBox();
  assert.ok(Math.abs(box.x + box.width / 2 - canvas.x - plot.x - plot.width / 2) < 3);
  assert.ok(Math.abs(box.y + box.height / 2 - plot.y - plot.height / 2) < 3);
  await save(page, "tour-ring");
  await page.mouse.move(canvas.x + canvas.width / 2, 300);
  assert.equal(await ring.isVisible(), false);
  await button(page, "the plot of N").focus();
  assert.equal(await ring.isVisible(), true);
  await goTo(page, 4);
  await call(page, "set", { panel: "plots" });
  await button(page, "the law").click();
  await drawn(page);
  assert.ok((await call(page, "widgets")).some((w) => w.group === "why" && w.label === "law"));
  assert.equal(await ring.isVisible(), true);
  await leave(page);
});

test("a failing run repeats, in slow motion", async () => {
  const page = await openPage(session);
  await goTo(page, 1);
  await page.evaluate(() => {
    window.times = [];
    window.substep.on("frame", ({ time }) => window.times.push(time));
  });
  await page.getByText(" s, slow motion").waitFor();
  await reply(page, "1,000 kg the chain tears at 0\\.35 s");
  await page.waitForFunction(() => window.times.some((t, i) => t < window.times[i - 1]),
    null, { timeout: 60000 });
  assert.ok(Math.max(...await page.evaluate(() => window.times)) < 1.4);
  await leave(page);
});

test("with reduced motion it stops at the end, and Play repeats it", async () => {
  const page = await openPage(session, { calm: true });
  await goTo(page, 1);
  await reports(page, "playing", false);
  assert.match((await call(page, "report")).verdict, /^fails/);
  await call(page, "play");
  await page.waitForFunction(() => window.substep.report().time < 0.3);
  await leave(page);
});

test("leaving restores the run, its comparison and the window", async () => {
  const page = await openPage(session, { fragment: "scene=bridge&mode=damping&compare=mode:none" });
  const { width } = await canvasBox(page);
  const labels = async () => (await call(page, "widgets")).map((w) => w.label);
  for (const close of [() => button(page, "Close the tour").click(), () => page.keyboard.press("Escape")]) {
    await goTo(page, steps);
    assert.ok((await canvasBox(page)).width < width);
    await button(page, "Error against cost").click();
    await close();
    await reports(page, "tour", 0);
    await drawn(page);
    const report = await call(page, "report");
    assert.deepEqual([report.scene, report.mode, report.playing], ["bridge", "damping", true]);
    assert.match(await page.evaluate(() => window.substep.link()), /compare=mode%3Anone|compare=mode:none/);
    assert.equal((await canvasBox(page)).width, width);
    assert.equal(await page.locator(".substep-ring").isVisible(), false);
    assert.ok((await labels()).includes("Controls") || (await labels()).includes("Explore"), "the controls are gone");
    assert.equal(await page.evaluate(() => document.activeElement.className), "substep-view");
  }
  await leave(page);
});

test("keyboard only: from the first screen through a step and out", async () => {
  const page = await openPage(session);
  await call(page, "set", { introduction: "on" });
  await page.waitForTimeout(1100);
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Tour");
  await page.keyboard.press("Enter");
  await page.getByText(`Tour, 1 of ${steps}`).waitFor();
  await drawn(page);
  const focused = () => page.evaluate(() => document.activeElement.textContent
    || document.activeElement.getAttribute("aria-label"));
  assert.equal(await focused(), "A heavy box on a thin chain", "the focus is not on the title");
  const reached = [];
  for (let i = 0; i < 4; ++i) {
    await page.keyboard.press("Tab");
    reached.push(await focused());
  }
  assert.deepEqual(reached, ["1,000 kg", "the joint error", "Next", "substep: simulation, controls and plots"]);
  await page.keyboard.press("Shift+Tab");
  await page.keyboard.press("Enter");
  assert.equal(await focused(), "Enough sub-steps hold it");
  await page.keyboard.press("Escape");
  await reports(page, "tour", 0);
  await leave(page);
});

test("its colours follow the theme of the laboratory", async () => {
  const page = await openPage(session);
  await goTo(page, 3);
  const back = () => tour(page).evaluate((e) => getComputedStyle(e).backgroundColor);
  const dark = await back();
  await call(page, "set", { theme: "light" });
  await drawn(page);
  assert.notEqual(await back(), dark);
  await page.evaluate(axe);
  assert.deepEqual(await findings(page), []);
  await leave(page);
});

test("a laboratory in an article has the tour as a card in its canvas", async () => {
  const page = await openPage(session, { path: "example/article.html" });
  const labels = await page.evaluate(async () => {
    const [lab] = Object.values(window.laboratories);
    lab.set({ tour: 2 });
    const drawn = () => lab.widgets().map((w) => w.label);
    for (let i = 0; i < 600 && !drawn().includes("Next"); ++i) {
      await new Promise((done) => { requestAnimationFrame(done); });
    }
    return drawn();
  });
  assert.ok(labels.includes("Next"), labels.join());
  assert.equal(await tour(page).count(), 0);
  await leave(page);
});
