// Accessibility: node tests/web/access_test.mjs [FOLDER OF THE BUILT PAGE] [all]
// Each size in one theme, or in both on request.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, describe, test } from "node:test";
import { all, call, drawn, leave, open, openPage, picture, reports, save } from "./browser.mjs";
import { difference, part } from "./pixels.mjs";

const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

let session;
before(async () => { session = await open({ rate: 15 }); });
after(() => session?.close());

const focused = (page) => page.evaluate(() =>
  document.activeElement.name || document.activeElement.className || document.activeElement.tagName);

/** Axe's serious and critical findings in the current page, as text. */
async function findings(page) {
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" ")}`);
}

for (const light of all ? [false, true] : [false]) {
  test(`axe finds nothing serious in an article, ${light ? "light" : "dark"}`, async () => {
    const page = await openPage(session, { path: "example/article.html", light });
    await page.evaluate(axe);
    assert.deepEqual(await findings(page), []);
    await page.locator("select").first().focus(); // shows the controls
    assert.deepEqual(await findings(page), []);
    await leave(page);
  });
}

for (const light of all ? [false, true] : [true]) {
  test(`axe finds nothing serious on the page of the step doctor, ${light ? "light" : "dark"}`, async () => {
    const page = await openPage(session, { path: "doctor.html", light });
    await page.evaluate(axe);
    assert.deepEqual(await findings(page), []);
    await page.click('[data-example="arm"]');
    await page.waitForFunction(() => document.querySelector("#details").textContent.includes("Remedies")
      && document.querySelector("#working").textContent === "", null, { timeout: 30000 });
    assert.deepEqual(await findings(page), []);
    await leave(page);
  });
}

// States of the page: in some the HTML has more content, in others it covers the canvas.
const states = {
  "a run": (page) => call(page, "set", { mode: "adaptive" }),
  "controls for the keyboard": (page) => page.locator("select").first().focus(),
  "a failure": async (page) => {
    await call(page, "set", { mode: "none" });
    await call(page, "step", 120);
  },
  "a file with problems": (page) => call(page, "load", "{}", "bad.json"),
  "a link with problems": (page) => call(page, "openLink", "#alpha=9"),
  help: (page) => call(page, "set", { help: "on" }),
  accuracy: (page) => call(page, "set", { help: "off", panel: "accuracy" }),
  comparison: (page) => call(page, "set", { panel: "compare", compare: "mode:none", views: "split" }),
  "the scene as text": (page) => call(page, "set", { panel: "editor" }),
  "the model by hand": (page) => page.locator("button[name=hand]").press("Enter"),
  "the tour": (page) => call(page, "set", { tour: 2 }),
  "the first screen": (page) => call(page, "set", { introduction: "on" }),
  "a lost context": (page) => page.evaluate(() => document.querySelector(".substep-view")
    .getContext("webgl2").getExtension("WEBGL_lose_context").loseContext()),
};
// Concurrently: they mostly wait until the HTML follows the canvas.
describe("axe finds nothing serious in any state", { concurrency: true }, () => {
  const displays = [[1280, 720, "dark"], [390, 844, "light"]];
  if (all) displays.push([1280, 720, "light"], [390, 844, "dark"]);
  for (const [width, height, theme] of displays) {
    test(`${width}x${height}, ${theme}`, async () => {
      const page = await openPage(session, { width, height, light: theme === "light" });
      await call(page, "pause");
      await page.evaluate(axe);
      for (const [state, reach] of Object.entries(states)) {
        await reach(page);
        await page.waitForTimeout(1100); // until the HTML twin is updated
        assert.deepEqual(await findings(page), [], state);
      }
      page.complaints = []; // of the browser, on the lost context
      await leave(page);
    });
  }
});

test("HTML mirrors the canvas, and announces only important changes", async () => {
  const page = await openPage(session);
  await page.evaluate(() => {
    const record = (list, element) =>
      new MutationObserver(() => list.push(element.textContent)).observe(element, { childList: true });
    record(window.said = [], document.querySelector(".substep-twin [aria-live=polite]"));
    record(window.times = [], document.querySelector(".substep-twin [data-field=state]"));
  });
  await page.waitForFunction(() => window.times.length >= 3, null, { timeout: 20000 });
  const twin = await page.locator(".substep-twin").textContent();
  for (const word of ["Swinging box", "adaptive, bpp, euler", "playing at", "holds"]) {
    assert.ok(twin.includes(word), `"${word}" is not in: ${twin}`);
  }
  const quietly = await page.evaluate(() => window.said.length);
  assert.ok(quietly <= 1, `${quietly} announcements while nothing happened`);
  await call(page, "set", { mode: "none" });
  await page.waitForFunction(() => window.said.some((text) => /none.*fails/.test(text)), null,
    { timeout: 20000 });
  await leave(page);
});

test("everything is operable by keyboard, and the focus can leave", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await call(page, "reset");
  await page.evaluate(() => {
    const button = Object.assign(document.createElement("button"), { name: "after" });
    document.body.append(button);
  });
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "substep-view");
  const plain = await picture(page);
  await page.keyboard.press(".");
  await reports(page, "frame", 1);
  const canvas = await page.locator(".substep-view").boundingBox();
  assert.ok(canvas.width === 1280);
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "scene");
  await drawn(page);
  await save(page, "keyboard-controls");
  // The canvas makes room for them, and no control of either covers the other.
  const bar = await page.locator(".substep-keys").boundingBox();
  const below = await page.locator(".substep-view").boundingBox();
  assert.ok(bar.y >= 0 && below.y >= bar.y + bar.height, JSON.stringify({ bar, below }));
  assert.ok(Math.abs(below.y + below.height - 720) < 1, "it ends where the page ends");
  assert.equal(await page.evaluate(() => document.scrollingElement.scrollTop), 0);
  assert.ok(difference(part(plain, { x: 0, y: 0, width: 1280, height: 56 }),
    part(await picture(page), { x: 0, y: 0, width: 1280, height: 56 })) > 0.2, "they are not visible");
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "mode");
  await page.keyboard.press("n");
  await reports(page, "mode", "none");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "alpha");
  assert.equal(await page.evaluate(() => document.activeElement.value), "0.1");
  await page.keyboard.press("Control+A");
  await page.keyboard.type("0.25");
  await page.keyboard.press("Tab");
  await reports(page, "alpha", 0.25);
  assert.equal(await focused(page), "play");
  await page.keyboard.press("Enter");
  await reports(page, "playing", true);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter"); // one frame pauses
  await reports(page, "playing", false);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await reports(page, "frame", 0);
  // The scene as text: an error is shown with its line, and mended the text runs.
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "text");
  await page.keyboard.press("Enter");
  assert.equal(await focused(page), "source");
  const source = page.locator("textarea[name=source]");
  const text = await source.inputValue();
  const line = text.slice(0, text.indexOf('"mass": 1000')).split("\n").length;
  const faults = page.locator(".substep-source li");
  await source.fill(text.replace('"mass": 1000', '"mass": -7'));
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "apply");
  await page.keyboard.press("Enter");
  assert.equal(await faults.count(), 1);
  assert.match(await faults.first().textContent(),
    new RegExp(`^Line ${line}, /bodies/\\d+/mass: must be at least 1e-30 .kg., not -7$`));
  assert.equal((await call(page, "report")).scene, "swinging_box");
  await source.fill(text.replace('"mass": 1000', '"mass": 700'));
  await page.locator("button[name=apply]").press("Enter");
  assert.equal(await faults.count(), 0);
  await reports(page, "scene", "swinging_box_own");
  assert.equal((await call(page, "report")).alpha, 0.25, "the method is kept");
  await page.locator("button[name=text]").press("Enter"); // folds it
  for (const name of ["new", "hand"]) {
    await page.keyboard.press("Tab");
    assert.equal(await focused(page), name);
  }
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "after", "the focus cannot leave");
  await page.waitForFunction(() => document.querySelector(".substep-view").getBoundingClientRect().y === 0);
  for (let i = 0; i < 11; ++i) await page.keyboard.press("Shift+Tab");
  assert.equal(await focused(page), "substep-view");
  await leave(page);
});

test("a ring shows the keyboard focus", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await drawn(page);
  const edge = { x: 0, y: 200, width: 3, height: 300 };
  const before = await picture(page, edge);
  await page.keyboard.press("Tab");
  await drawn(page);
  assert.ok(difference(before, await picture(page, edge)) > 0.9, "no ring after Tab");
  await page.mouse.click(620, 300);
  await drawn(page);
  assert.ok(difference(before, await picture(page, edge)) < 0.1, "a ring after a click");
  await leave(page);
});

test("keys work before the first click", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await call(page, "reset");
  await page.keyboard.press(".");
  await reports(page, "frame", 1);
  await leave(page);
});

test("prefers-reduced-motion is respected", async () => {
  const page = await openPage(session, { calm: true });
  await call(page, "pause");
  await page.waitForTimeout(1700);
  await page.keyboard.press("f"); // the camera is not animated: it is in place in the next picture
  await drawn(page);
  const there = await picture(page, { x: 300, y: 100, width: 600, height: 500 });
  await page.waitForTimeout(1000);
  assert.ok(difference(there, await picture(page, { x: 300, y: 100, width: 600, height: 500 })) < 0.001);
  await leave(page);
});
