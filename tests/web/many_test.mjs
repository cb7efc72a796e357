// More laboratories on a page than may hold graphics contexts, web/graphics.mjs:
// node tests/web/many_test.mjs [FOLDER OF THE BUILT PAGE] [all]
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { all, drawn, leave, open, openPage, picture } from "./browser.mjs";
import { variance } from "./pixels.mjs";

const count = all ? 20 : 8; // browsers give a page some 16 contexts, this one takes at most 6

let session;
before(async () => { session = await open(); });
after(() => session?.close());

/** A page with laboratories below each other, two of them in view. */
async function openMany() {
  const page = await openPage(session, { path: "files.json", width: 640 });
  await page.evaluate(async (n) => {
    const { createSubstep } = await import(new URL("substep.mjs", location.href).href);
    const openOne = (i) => {
      const place = Object.assign(document.createElement("div"), { id: `place${i}` });
      place.style.height = "360px";
      document.body.append(place);
      return createSubstep(place, { scene: "bridge", settings: { panels: "off" }, play: false });
    };
    const half = n / 2; // half one after the other, the rest at once
    window.laboratories = [];
    for (let i = 0; i < half; ++i) window.laboratories.push(await openOne(i));
    const others = Array.from({ length: n - half }, (_, i) => openOne(half + i));
    window.laboratories.push(...await Promise.all(others));
  }, count);
  return page;
}

/** Scrolls one into view and waits until it draws. @returns its picture */
async function look(page, i) {
  await page.evaluate((n) => document.getElementById(`place${n}`).scrollIntoView(), i);
  const heard = await page.evaluate((n) => new Promise((done) => {
    const lab = window.laboratories[n];
    const leave = lab.on("frame", () => {
      leave();
      done(true);
    });
    lab.step();
    setTimeout(() => done(false), 10000);
  }), i);
  assert.ok(heard, `laboratory ${i} draws nothing`);
  await drawn(page);
  const hidden = await page.evaluate((n) =>
    document.querySelector(`#place${n} .substep-overlay`).hidden, i);
  assert.ok(hidden, `a card covers laboratory ${i}`);
  return picture(page, await page.locator(`#place${i}`).boundingBox());
}

test("each of many laboratories draws when it is visible", async () => {
  const page = await openMany();
  const order = Array.from({ length: count }, (_, i) => i);
  // All in order, back to the first one, then some in arbitrary order.
  const visits = [...order, 0, count - 1, 7, 3, 12 % count, 0];
  for (const i of visits) {
    assert.ok(variance(await look(page, i)) > 20, `laboratory ${i} is blank`);
  }
  // This page has no icon. A browser that took a context may first refuse it: the request is repeated.
  page.complaints = page.complaints.filter(
    (text) => !/404|context restoration not allowed/.test(text));
  const frames = await page.evaluate(() => window.laboratories.map((lab) => lab.report().frame));
  assert.deepEqual(frames, order.map((i) => visits.filter((v) => v === i).length));
  await leave(page);
});

test("a context lost to other canvases of the page is restored", { skip: !all }, async () => {
  const page = await openMany();
  await look(page, 0);
  await page.evaluate(() => {
    const canvases = Array.from({ length: 16 }, () => document.createElement("canvas"));
    window.others = canvases.map((canvas) => canvas.getContext("webgl2"));
  });
  const card = (hidden) => page.waitForFunction((h) =>
    document.querySelector("#place0 .substep-overlay").hidden === h, hidden);
  await card(false);
  await card(true);
  for (const i of [0, 15, 19, 1]) {
    assert.ok(variance(await look(page, i)) > 20, `laboratory ${i} is blank`);
  }
});
