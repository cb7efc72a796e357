// The address holds the experiment: node tests/web/link_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { inflateRawSync } from "node:zlib";
import { call, drawn, drop, leave, open, openMenu, openPage, packScene, pick, reports,
  save } from "./browser.mjs";

let session;
before(async () => { session = await open({ rate: 15 }); });
after(() => session?.close());

const fragmentOf = (link) => link.slice(link.indexOf("#") + 1);

/** The hash of the run's state after some frames from its start. */
async function hashAfter(page, frames) {
  await call(page, "pause");
  await call(page, "reset");
  await call(page, "step", frames);
  return call(page, "hash");
}

/** A user's scene: the pendulum with another frame length. */
async function ownScene(name = "mine") {
  const scene = JSON.parse(await readFile(new URL("../../scenes/pendulum.json", import.meta.url), "utf8"));
  return JSON.stringify({ ...scene, name, title: `My ${name}`, frame: 0.0125 });
}

test("is read when the page opens", async () => {
  const page = await openPage(session,
    { fragment: "scene=bridge&solver=pgs&mode=const&n=12&integrator=leapfrog", light: true });
  const report = await call(page, "report");
  assert.deepEqual([report.scene, report.solver, report.mode, report.integrator],
    ["bridge", "pgs", "const", "leapfrog"]);
  await call(page, "pause");
  assert.equal((await call(page, "step", 60)).substeps, 12);
  await save(page, "bridge-light");
  await leave(page);
});

test("reproduces the run, bit for bit", async () => {
  const first = await openPage(session);
  await call(first, "set", { scene: "heavy_stack", solver: "pgs", mode: "capped", n_cap: 3,
    alpha: 0.0371, iterations: 11, warm_start: false, integrator: "leapfrog", drift: "soft" });
  await first.waitForURL(/n_cap=3/);
  const hash = await hashAfter(first, 50);
  const fragment = fragmentOf(first.url());
  await leave(first);
  const second = await openPage(session, { fragment });
  assert.equal(await hashAfter(second, 50), hash);
  assert.equal((await call(second, "report")).scene, "heavy_stack");
  await leave(second);
});

test("supports back and forward between scenes", async () => {
  const page = await openPage(session, { fragment: "scene=swinging_box&mode=none" });
  await call(page, "set", { scene: "bridge" });
  await page.waitForURL(/scene=bridge/);
  await call(page, "set", { alpha: 0.3 }); // adds no entry to the browser history
  await page.waitForURL(/alpha=0\.3/);
  await call(page, "set", { scene: "heavy_stack" });
  await page.waitForURL(/scene=heavy_stack/);
  await page.goBack();
  await reports(page, "scene", "bridge");
  assert.equal((await call(page, "report")).alpha, 0.3);
  await page.goBack();
  await reports(page, "scene", "swinging_box");
  assert.equal((await call(page, "report")).mode, "none");
  await page.goForward();
  await reports(page, "scene", "bridge");
  await page.goForward();
  await reports(page, "scene", "heavy_stack");
  await page.waitForFunction(() => /^Heavy stack/.test(document.title));
  await leave(page);
});

test("follows changes of the address", async () => {
  const page = await openPage(session);
  await page.evaluate(() => { location.hash = "#scene=bridge&mode=damping"; });
  await reports(page, "scene", "bridge");
  assert.equal((await call(page, "report")).mode, "damping");
  await leave(page);
});

test("contains a user's scene, and another browser runs it", async () => {
  const page = await openPage(session);
  await drop(page, "mine.json", await ownScene());
  await call(page, "set", { mode: "const", n: 5 });
  await page.waitForURL(/scene64=/);
  // Edited as text, it is in the link as edited; edits are no pages to go back to.
  const entries = await page.evaluate(() => history.length);
  const { text } = await call(page, "sceneText");
  const longer = text.replace(/"gravity": .*/, '"gravity": [0, -3.7, 0],');
  assert.notEqual(longer, text);
  const before = await call(page, "link");
  const edited = await call(page, "editText", longer);
  assert.deepEqual([edited.ok, edited.runs, edited.problems], [true, true, []]);
  await page.waitForFunction((old) => location.href !== old, before);
  const link = await call(page, "link");
  assert.equal(await page.evaluate(() => history.length), entries);
  assert.ok(link.length < 2000, `${link.length} letters`);
  const hash = await hashAfter(page, 40);
  await leave(page); // and what it stored
  const other = await openPage(session, { fragment: fragmentOf(link) });
  const report = await call(other, "report");
  assert.deepEqual([report.scene, report.title, report.mode], ["mine", "My mine", "const"]);
  assert.equal(await hashAfter(other, 40), hash);
  await leave(other);
});

test("contains a model built with the plain controls, and another browser runs it", async () => {
  const page = await openPage(session);
  const press = (edit) => page.locator(`[data-edit=${edit}]`).press("Enter");
  await press("new");
  await reports(page, "scene", "my_scene");
  await page.locator("button[name=hand]").press("Enter");
  for (const edit of ["link", "link", "link", "link", "link", "ball"]) await press(edit);
  assert.deepEqual(await page.locator("select[name=select] option").allTextContents(),
    ["none", "floor", "link_1", "link_2", "link_3", "link_4", "link_5", "ball_1"]);
  await reports(page, "selected", "ball_1");
  await page.locator("input[name=edit]").fill("mass:1000");
  await page.locator("input[name=edit]").press("Enter");
  await page.waitForFunction(() => /"mass": 1000/.test(window.substep.sceneText().text));
  await page.locator("input[name=edit]").fill("mass:-1");
  await page.locator("input[name=edit]").press("Enter");
  await page.waitForFunction(() => /at least 1e-30/.test(
    document.querySelector(".substep-twin [aria-live]").textContent));
  await drawn(page);
  await save(page, "model");
  await page.waitForURL(/scene64=/);
  const link = await call(page, "link");
  const hash = await hashAfter(page, 60);
  await leave(page);
  const other = await openPage(session, { fragment: fragmentOf(link) });
  assert.equal((await call(other, "report")).scene, "my_scene");
  assert.equal(await hashAfter(other, 60), hash);
  await leave(other);
});

test("packs a scene in the format of the tests", async () => {
  const page = await openPage(session);
  const text = await ownScene();
  const [packed, unpacked] = await page.evaluate(async ([scene, letters]) => {
    const { pack, unpack } = await import(new URL("inline_scene.mjs", location.href).href);
    return [await pack(scene), await unpack(letters)];
  }, [text, packScene(text)]);
  assert.match(packed, /^[\w-]+$/);
  assert.equal(inflateRawSync(Buffer.from(packed, "base64url")).toString(), text);
  assert.equal(unpacked, text);
  await leave(page);
});

test("contains thrown balls in compact form, and another browser throws them again", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await call(page, "reset");
  await page.mouse.move(620, 300);
  for (let i = 0; i < 3; ++i) { // tests/app/ui throws twenty
    await call(page, "step", 3);
    await page.keyboard.press("b");
    await drawn(page);
  }
  await call(page, "step", 30);
  await page.waitForURL(/events=/);
  const [link, hash] = [await call(page, "link"), await call(page, "hash")];
  assert.ok(link.length < 500, `${link.length} letters`);
  await leave(page);
  const other = await openPage(session, { fragment: fragmentOf(link) });
  assert.equal(await hashAfter(other, 39), hash);
  await leave(other);
});

test("that is invalid is reported, and the page runs", async () => {
  const broken = ["mode=warp&alpha=7&%zz&=&scene=%00", "scene=no_such_scene", "scene64=AAAA",
    "scene64=%%%", "scene64=", "&&&", `scene64=${"A".repeat(5000)}`, "alpha=1e999&n=-3&solver="];
  const page = await openPage(session, { fragment: broken[0] });
  assert.match((await call(page, "report")).trouble, /link/);
  await drawn(page);
  await save(page, "bad-link");
  for (const fragment of broken) {
    const before = await call(page, "report");
    const result = await call(page, "openLink", fragment);
    const now = await call(page, "report");
    assert.equal(now.scene, before.scene, fragment);
    if (fragment === "&&&") continue;
    assert.equal(result.ok, false, fragment);
    assert.match(now.trouble, /link/, fragment);
    assert.ok(result.problems.every((p) => p.message.length > 5), JSON.stringify(result.problems));
  }
  await drawn(page);
  await leave(page);
});

test("and the command are copied from the menu", async () => {
  const page = await openPage(session);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await call(page, "set", { mode: "const", n: 9 });
  await call(page, "pause");
  await call(page, "reset");
  await page.waitForURL(/n=9/);
  await openMenu(page);
  await save(page, "share-menu");
  await page.keyboard.press("Escape");
  await drawn(page);
  const copied = async (entry) => {
    await page.evaluate(() => navigator.clipboard.writeText("nothing yet"));
    await pick(page, entry);
    // waitForFunction() does not await the promise of its function.
    let text = "nothing yet";
    for (let i = 0; i < 100 && text === "nothing yet"; ++i) {
      await page.waitForTimeout(50);
      text = await page.evaluate(() => navigator.clipboard.readText());
    }
    return text;
  };
  assert.equal(await copied("Copy link"), page.url());
  assert.match((await call(page, "report")).notice, /Link copied/);
  // Of this moment, from another place than the scene's own camera.
  await call(page, "step", 30);
  await page.mouse.move(620, 300);
  await page.mouse.wheel(0, -300);
  await drawn(page);
  const moment = await copied("Copy link to this moment and view");
  assert.match(moment, /&at=0\.5&camera=[-0-9.,]+$/);
  const hash = await call(page, "hash");
  const other = await openPage(session, { fragment: fragmentOf(moment) });
  await reports(other, "frame", 30);
  assert.equal(await call(other, "hash"), hash);
  await leave(other);
  // Within another page.
  const html = await copied("Copy HTML to embed it");
  assert.match(html, /^<iframe src="[^"]+&amp;[^"]+" title="substep: Swinging box"/);
  const outer = await session.browser.newContext({ serviceWorkers: "block" });
  const article = await outer.newPage();
  const theirs = `${session.address}theirs.html`;
  await article.route(theirs, (route) => route.fulfill({ contentType: "text/html", body: html }));
  await article.goto(theirs);
  const inner = await (await article.waitForSelector("iframe")).contentFrame();
  await inner.waitForFunction(() => window.substep?.report().mode === "const", null, { timeout: 60000 });
  await outer.close();
  await call(page, "reset");
  assert.equal(await copied("Copy command"), "./dev cli run swinging_box --mode const --n 9");
  assert.equal(await call(page, "command"), "./dev cli run swinging_box --mode const --n 9");
  await leave(page);
});
