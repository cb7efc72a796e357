// A first visit: two chains on one clock, and the way into the laboratory:
// node tests/web/first_test.mjs [FOLDER OF THE BUILT PAGE] [all]
// In two windows, or in all on request.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { all, call, click, drawn, leave, open, openPage, picture, reports, save } from "./browser.mjs";
import { difference, part, variance } from "./pixels.mjs";

let session;
before(async () => { session = await open({ rate: 15 }); });
after(() => session?.close());

/** Waits until the first screen is shown or hidden. */
const introduced = (page, shown) => page.waitForFunction(
  (s) => (window.substep.report().introduction !== null) === s, shown, { timeout: 20000 });

/** Waits until the first screen reports that the left chain has torn. */
const torn = (page) => page.waitForFunction(
  () => /Torn at 0.35 s/.test(window.substep.report().introduction?.torn), null, { timeout: 60000 });

const left = { x: 40, y: 140, width: 560, height: 360 };
const right = { x: 680, y: 140, width: 560, height: 360 };

const visits = [[1280, 720, "dark"], [390, 844, "light"]];
if (all) visits.push([1280, 720, "light"], [390, 844, "dark"], [1920, 1080, "dark"], [1920, 1080, "light"]);
for (const [width, height, theme] of visits) {
  test(`${width}x${height}, ${theme}: one chain tears beside one that holds`, async () => {
    const page = await openPage(session, { width, height, light: theme === "light", first: true });
    await introduced(page, true);
    await torn(page);
    const { introduction, mode, verdict } = await call(page, "report");
    assert.match(introduction.held, /^Adaptive: N sub-steps, now 1\d/);
    assert.match(introduction.paper, /Adaptive Sub-stepping for Constrained.*Giles.*Andrews/);
    assert.deepEqual([mode, verdict], ["adaptive", "holds"]);
    const now = await picture(page);
    await save(page, `first-${width}-${theme}`, now);
    if (width === 1280) {
      assert.ok(variance(part(now, left)) > 40 && variance(part(now, right)) > 40, "a picture is blank");
      await page.waitForTimeout(1000);
      const later = await picture(page);
      for (const side of [left, right]) {
        assert.ok(difference(part(now, side), part(later, side)) > 0.002, "a chain does not move");
      }
    }
    await leave(page);
  });
}

test("Try it opens the laboratory, also at later visits", async () => {
  const page = await openPage(session, { first: true });
  await introduced(page, true);
  assert.equal(await page.evaluate(() => location.hash), "", "the address is no longer plain");
  await drawn(page); // a click before the first picture would hit nothing
  await click(page, "Try it");
  await introduced(page, false);
  const report = await call(page, "report");
  assert.deepEqual([report.scene, report.mode, report.playing], ["swinging_box", "adaptive", true]);
  await page.waitForFunction(() => /scene=swinging_box/.test(location.hash));
  assert.ok(!/compare/.test(await page.evaluate(() => location.hash)));
  await page.goto("about:blank");
  await page.goto(session.address);
  await page.waitForFunction(() => window.substep, null, { timeout: 60000 });
  await drawn(page);
  await introduced(page, false);
  await leave(page);
});

test("Enter, Escape and a tap close it; Tour begins the tour", async () => {
  const page = await openPage(session, { first: true });
  for (const close of [() => page.keyboard.press("Enter"), () => page.keyboard.press("Escape"),
    () => page.mouse.click(320, 300), () => click(page, "Tour")]) {
    await call(page, "set", { introduction: "on" });
    await introduced(page, true);
    await drawn(page);
    await close();
    await introduced(page, false);
  }
  assert.equal((await call(page, "report")).tour, 1);
  await leave(page);
});

test("a link and the API skip it", async () => {
  const linked = await openPage(session, { first: true, fragment: "scene=bridge&mode=none" });
  assert.equal((await call(linked, "report")).introduction, null);
  await reports(linked, "scene", "bridge");
  await leave(linked);
  const page = await openPage(session, { first: true });
  await introduced(page, true);
  await call(page, "set", { mode: "damping" });
  await introduced(page, false);
  assert.equal((await call(page, "report")).mode, "damping");
  await leave(page);
});

test("HTML has the same text and two buttons for the keyboard", async () => {
  const page = await openPage(session, { first: true });
  await introduced(page, true);
  await page.waitForTimeout(1100);
  const twin = await page.locator(".substep-twin").textContent();
  for (const words of ["A laboratory for stable constrained rigid bodies", "One step per frame",
    "Adaptive: N sub-steps", "Giles and S. Andrews"]) {
    assert.ok(twin.includes(words), `"${words}" is not in: ${twin}`);
  }
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Try it");
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Tour");
  await page.keyboard.press("Shift+Tab");
  await page.keyboard.press("Enter");
  await introduced(page, false);
  assert.equal(await page.evaluate(() => document.activeElement.name), "scene");
  assert.equal(await page.getByRole("button", { name: "Try it" }).count(), 0, "it is still there");
  await leave(page);
});

test("without JavaScript the page says what it is, with a picture", async () => {
  for (const [width, height] of [[1280, 720], [390, 844]]) {
    const context = await session.browser.newContext(
      { javaScriptEnabled: false, viewport: { width, height } });
    const page = await context.newPage();
    await page.goto(session.address);
    const card = page.locator(".substep-plain .substep-card");
    await card.click({ trial: true }); // it is visible, and nothing covers it
    assert.match(await card.textContent(), /stable constrained rigid bodies.*needs JavaScript/s);
    const box = await card.locator("img").boundingBox();
    assert.ok(box.width > 250 && box.height > 140 && box.y >= 0, JSON.stringify(box));
    assert.equal(await page.locator("#laboratory").isVisible(), false);
    await save(page, `no-javascript-${width}`);
    await context.close();
  }
});

test("a laboratory in an article starts without it", async () => {
  const page = await openPage(session, { path: "example/article.html", first: true });
  const shown = await page.evaluate(() => Object.values(window.laboratories)
    .map((l) => l.report().introduction));
  assert.ok(shown.every((words) => words === null));
  await leave(page);
});
