// Accessibility: node tests/web/access_test.mjs [BUILT PAGE]
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, describe, test } from "node:test";
import { call, drawn, open, openPage, picture, quiet, reports, save } from "./browser.mjs";
import { difference, part } from "./pixels.mjs";

const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

let session;
before(async () => { session = await open(); });
after(() => session?.close());

const focused = (page) => page.evaluate(() =>
  document.activeElement.name || document.activeElement.className || document.activeElement.tagName);

/** Axe's serious and critical findings in the current page, as text. */
async function findings(page) {
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" ")}`);
}

for (const light of [false, true]) {
  for (const path of ["", "example/article.html"]) {
    test(`axe finds nothing serious on ${path || "index.html"}, ${light ? "light" : "dark"}`, async () => {
      const page = await openPage(session, { path, light, before: "1" });
      await page.waitForFunction(() => window.substep ?? window.laboratories, null, { timeout: 60000 });
      await page.evaluate(axe);
      assert.deepEqual(await findings(page), []);
      await page.locator("select").first().focus(); // shows the controls
      assert.deepEqual(await findings(page), []);
      quiet(page);
      await page.context().close();
    });
  }
}

// States of the page: in some the HTML has more content, in others it covers the canvas.
const states = {
  "a run": (page) => call(page, "set", { mode: "adaptive" }),
  "a failure": async (page) => {
    await call(page, "set", { mode: "none" });
    await call(page, "step", 120);
  },
  "a file with problems": (page) => call(page, "load", "{}", "bad.json"),
  "a link with problems": (page) => call(page, "openLink", "#alpha=9"),
  help: (page) => call(page, "set", { help: "on" }),
  accuracy: (page) => call(page, "set", { help: "off", panel: "accuracy" }),
  comparison: (page) => call(page, "set", { panel: "compare", compare: "mode:none", views: "split" }),
  "the tour": (page) => call(page, "set", { tour: 2 }),
  "the first screen": (page) => call(page, "set", { introduction: "on" }),
  "a lost context": (page) => page.evaluate(() => document.querySelector(".substep-view")
    .getContext("webgl2").getExtension("WEBGL_lose_context").loseContext()),
};
// Concurrently: they mostly wait until the HTML follows the canvas.
describe("axe finds nothing serious in any state", { concurrency: true }, () => {
  for (const [width, height] of [[1280, 720], [390, 844]]) {
    for (const light of [false, true]) {
      test(`${width}x${height}, ${light ? "light" : "dark"}`, async () => {
        const page = await openPage(session, { width, height, light });
        await call(page, "pause");
        await page.evaluate(axe);
        for (const [state, reach] of Object.entries(states)) {
          await reach(page);
          await page.waitForTimeout(1100); // until the HTML twin is updated
          assert.deepEqual(await findings(page), [], state);
        }
        await page.context().close();
      });
    }
  }
});

test("HTML mirrors the canvas, and announces only important changes", async () => {
  const page = await openPage(session);
  await page.evaluate(() => {
    window.said = [];
    const live = document.querySelector(".substep-twin [aria-live=polite]");
    new MutationObserver(() => window.said.push(live.textContent)).observe(live, { childList: true });
  });
  await page.waitForTimeout(4000);
  const twin = await page.locator(".substep-twin").textContent();
  for (const word of ["Swinging box", "adaptive, bpp, euler", "playing at", "holds"]) {
    assert.ok(twin.includes(word), `"${word}" is not in: ${twin}`);
  }
  const quietly = await page.evaluate(() => window.said.length);
  assert.ok(quietly <= 1, `${quietly} announcements while nothing happened`);
  await call(page, "set", { mode: "none" });
  await page.waitForFunction(() => window.said.some((text) => /none.*fails/.test(text)), null,
    { timeout: 20000 });
  quiet(page);
  await page.context().close();
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
  assert.equal((await page.locator(".substep-view").boundingBox()).y, 0, "the page was scrolled");
  assert.ok(difference(part(plain, { x: 0, y: 0, width: 1280, height: 56 }),
    part(await picture(page), { x: 0, y: 0, width: 1280, height: 56 })) > 0.2, "they are not visible");
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "mode");
  await page.keyboard.press("n");
  await reports(page, "mode", "none");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "alpha");
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
  await page.keyboard.press("Tab");
  assert.equal(await focused(page), "after", "the focus cannot leave");
  for (let i = 0; i < 8; ++i) await page.keyboard.press("Shift+Tab");
  assert.equal(await focused(page), "substep-view");
  quiet(page);
  await page.context().close();
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
  await page.context().close();
});

test("keys work before the first click", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await call(page, "reset");
  await page.keyboard.press(".");
  await reports(page, "frame", 1);
  quiet(page);
  await page.context().close();
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
  quiet(page);
  await page.context().close();
});
