// The address holds the experiment: node tests/web/link_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { call, drawn, drop, open, openMenu, openPage, pick, quiet, reports, save } from "./browser.mjs";

let session;
before(async () => { session = await open(); });
after(() => session?.close());

const fragmentOf = (page) => page.evaluate(() => location.hash);
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
  quiet(page);
  await page.context().close();
});

test("reproduces the run, bit for bit", async () => {
  const first = await openPage(session);
  await call(first, "set", { scene: "heavy_stack", solver: "pgs", mode: "capped", n_cap: 3,
    alpha: 0.0371, iterations: 11, warm_start: false, integrator: "leapfrog", drift: "soft" });
  await first.waitForURL(/n_cap=3/);
  await call(first, "pause");
  await call(first, "reset");
  await call(first, "step", 50);
  const second = await openPage(session, { fragment: (await fragmentOf(first)).slice(1) });
  await call(second, "pause");
  await call(second, "reset");
  await call(second, "step", 50);
  assert.equal(await call(second, "hash"), await call(first, "hash"));
  await reports(second, "scene", "heavy_stack");
  await first.context().close();
  await second.context().close();
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
  quiet(page);
  await page.context().close();
});

test("follows changes of the address", async () => {
  const page = await openPage(session);
  await page.evaluate(() => { location.hash = "#scene=bridge&mode=damping"; });
  await reports(page, "scene", "bridge");
  assert.equal((await call(page, "report")).mode, "damping");
  quiet(page);
  await page.context().close();
});

test("contains a user's scene, and another browser runs it", async () => {
  const page = await openPage(session);
  await drop(page, "mine.json", await ownScene());
  await call(page, "set", { mode: "const", n: 5 });
  await page.waitForURL(/scene64=/);
  const link = await call(page, "link");
  assert.ok(link.length < 2000, `${link.length} letters`);
  await call(page, "pause");
  await call(page, "reset");
  await call(page, "step", 40);
  const other = await openPage(session, { fragment: link.slice(link.indexOf("#") + 1) });
  const report = await call(other, "report");
  assert.deepEqual([report.scene, report.title, report.mode], ["mine", "My mine", "const"]);
  await call(other, "pause");
  await call(other, "reset");
  await call(other, "step", 40);
  assert.equal(await call(other, "hash"), await call(page, "hash"));
  quiet(other);
  await page.context().close();
  await other.context().close();
});

test("contains thrown balls in compact form, and another browser throws them again", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await call(page, "reset");
  await page.mouse.move(620, 300);
  for (let i = 0; i < 20; ++i) {
    await call(page, "step", 3);
    await page.keyboard.press("b");
    await drawn(page);
  }
  await call(page, "step", 30);
  await page.waitForURL(/events=/);
  const link = await call(page, "link");
  assert.ok(link.length < 2000, `${link.length} letters`);
  const frame = Math.round((await call(page, "report")).time * 60);
  const other = await openPage(session, { fragment: link.slice(link.indexOf("#") + 1) });
  await call(other, "pause");
  await call(other, "reset");
  await call(other, "step", frame);
  assert.equal(await call(other, "hash"), await call(page, "hash"));
  quiet(other);
  await page.context().close();
  await other.context().close();
});

test("that is invalid is reported, and the page runs", async () => {
  const broken = ["mode=warp&alpha=7&%zz&=&scene=%00", "scene=no_such_scene", "scene64=AAAA",
    "scene64=%%%", "scene64=", "&&&", `scene64=${"A".repeat(5000)}`, "alpha=1e999&n=-3&solver="];
  const page = await openPage(session);
  for (const fragment of broken) {
    const before = await call(page, "report");
    const result = await call(page, "openLink", fragment);
    await drawn(page);
    const now = await call(page, "report");
    assert.equal(now.scene, before.scene, fragment);
    if (fragment === "&&&") continue;
    assert.equal(result.ok, false, fragment);
    assert.match(now.trouble, /link/, fragment);
    assert.ok(result.problems.every((p) => p.message.length > 5), JSON.stringify(result.problems));
  }
  const opened = await openPage(session, { fragment: broken[0] });
  await drawn(opened);
  assert.match((await call(opened, "report")).trouble, /link/);
  await save(opened, "bad-link");
  quiet(page);
  quiet(opened);
  await page.context().close();
  await opened.context().close();
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
  assert.equal(await copied("Copy command"), "./dev cli run swinging_box --mode const --n 9");
  assert.equal(await call(page, "command"), "./dev cli run swinging_box --mode const --n 9");
  quiet(page);
  await page.context().close();
});
