// Hosting, loading and offline use:
// node tests/web/offline_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { measure, total } from "../../web/sizes.mjs";
import { call, drawn, leave, open, openPage, save } from "./browser.mjs";

const mostBytes = 1.5e6; // of all files, packed with gzip

let folder; // served by the server; a copy that tests may change
let session;
let stored; // a page with a stored copy
before(async () => {
  session = await open({ rate: 15 });
  folder = session.folder;
});
after(() => session?.close());

const running = (page) => page.waitForFunction(() => window.substep, null, { timeout: 60000 });

test("all files together are small", async () => {
  const { gzip } = total(await measure(folder));
  assert.ok(gzip > 1e5 && gzip < mostBytes, `${gzip} bytes`);
});

test("no file requests anything outside its folder", async () => {
  const page = await openPage(session);
  const requests = [];
  page.on("request", (request) => requests.push(request.url()));
  await page.reload();
  await running(page);
  assert.ok(requests.length > 5);
  // Below the sub-path: it works from any folder of any server.
  for (const url of requests) assert.ok(url.startsWith(session.address), url);
  await leave(page);
});

test("a failed download can be retried, and progress is shown while the program loads", async () => {
  const page = await openPage(session, { fragment: "scene=bridge" });
  await page.route(/engine\.wasm/, (route) => route.abort());
  await page.reload();
  await page.locator(".substep-card button").waitFor();
  assert.match(await page.locator(".substep-card p").innerText(), /engine\.wasm.*network/);
  await save(page, "load-failed");
  await page.unroute(/engine\.wasm/);
  await page.route(/engine\.data/, async (route) => {
    await new Promise((done) => { setTimeout(done, 1500); });
    await route.continue();
  });
  await page.locator(".substep-card button").click();
  await page.waitForFunction(() => document.querySelector(".substep-card progress")?.value > 0.5);
  await save(page, "loading");
  await running(page);
  assert.ok(await page.locator(".substep-overlay").isHidden());
  assert.equal((await call(page, "report")).scene, "bridge");
  await page.context().close(); // it logged the failure
});

/** Names of the complete copies that are kept. */
const kept = (page) => page.evaluate(async () => {
  const whole = [];
  for (const name of await caches.keys()) {
    if (await caches.has(name) && (await (await caches.open(name)).keys()).length > 0) whole.push(name);
  }
  return whole.join();
});

/** Waits for a condition that is a promise: waitForFunction() takes any promise for true. */
async function until(condition, what) {
  for (const end = Date.now() + 30000; Date.now() < end;) {
    if (await condition()) return;
    await new Promise((done) => { setTimeout(done, 50); });
  }
  assert.fail(`waited 30 s for ${what}`);
}

/** Counts how often the list of files was served: a page with a worker asks once for a new version. */
function countLooks() {
  let served = 0;
  session.server.on("request", ({ url }, response) => {
    if (url.endsWith("/files.json")) response.on("finish", () => { ++served; });
  });
  return () => served;
}

test("a new version replaces the stored one", async () => {
  const looks = countLooks();
  const page = await openPage(session, { offline: true });
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller);
  assert.equal(looks(), 1, "that of the worker's installation");
  assert.match(await kept(page), /^substep .*some\/path\/ [0-9a-f]{16}$/);

  const list = join(folder, "files.json");
  const old = await readFile(list, "utf8");
  await writeFile(list, old.replace(/"version": "[0-9a-f]+"/, '"version": "0123456789abcdef"'));
  const index = join(folder, "index.html");
  await writeFile(index, (await readFile(index, "utf8")).replace("<head>", '<head data-version="new">'));

  // The next start loads the old version, which finds the new one. The page has not been used yet.
  await page.goto("about:blank");
  await page.goto(session.address);
  await page.waitForFunction(() => document.head.dataset.version === "new", null, { timeout: 30000 });
  await running(page);
  assert.match(await kept(page), /^substep .*some\/path\/ 0123456789abcdef$/);

  // A page in use is not replaced: the new version is used at the next start.
  await until(() => looks() >= 3, "the looks of the old and the new version");
  await writeFile(list, old);
  await writeFile(index, (await readFile(index, "utf8")).replace('"new"', '"newer"'));
  await page.addInitScript(() => { // a key before anything else can happen
    window.addEventListener("DOMContentLoaded", () => {
      window.dispatchEvent(new KeyboardEvent("keydown", { key: "Shift" }));
    });
  });
  await page.goto("about:blank");
  await page.goto(session.address, { waitUntil: "domcontentloaded" });
  await running(page);
  await until(async () => (await kept(page)).split(",").length === 2, "a copy of the newer version");
  assert.equal(await page.evaluate(() => document.head.dataset.version), "new");
  await page.close();
  // The browser activates it some time after the last page of the old version was closed.
  let next = null;
  for (let i = 0; i < 20 && await next?.evaluate(() => document.head.dataset.version) !== "newer"; ++i) {
    await next?.close();
    await new Promise((done) => { setTimeout(done, 100 * i); });
    next = await openPage(session, { context: page.context() });
  }
  assert.equal(await next.evaluate(() => document.head.dataset.version), "newer");
  assert.equal((await kept(next)).split(",").length, 1);
  await next.context().close();
});

test("an incomplete download keeps the stored version", async () => {
  const page = await openPage(session, { offline: true });
  stored = page;
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller);
  const list = join(folder, "files.json");
  const old = await readFile(list, "utf8");
  await writeFile(list, old.replace(/"version": "[0-9a-f]+"/, '"version": "00000000deadbeef"')
    .replace('"twin.mjs"', '"twin.mjs", "not_uploaded_yet.mjs"'));
  const failed = new Promise((done) => {
    session.server.on("request", ({ url }) => { if (url.endsWith("not_uploaded_yet.mjs")) done(); });
  });
  await page.goto(session.address);
  await failed;
  await page.goto("about:blank");
  await page.goto(session.address);
  await running(page);
  assert.equal((await call(page, "report")).scene, "swinging_box");
  await writeFile(list, old);
});

// Must be last: it stops the server.
test("a loaded page works without a network", async () => {
  const page = stored;
  session.server.close();
  session.server.closeAllConnections();
  // A reload right after a change of the fragment alone may load the fragment before.
  await page.goto("about:blank");
  await page.goto(`${session.address}#scene=bridge&mode=none`);
  await running(page);
  await drawn(page);
  assert.equal((await call(page, "report")).scene, "bridge");
  await page.goto(`${session.address}example/article.html`);
  await page.waitForFunction(() => window.laboratories, null, { timeout: 60000 });
});
