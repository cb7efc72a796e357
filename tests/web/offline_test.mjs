// Hosting, loading and living without a network:
// node tests/web/offline_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { cp, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { measure, total } from "../../web/sizes.mjs";
import { call, distFolder, drawn, open, openPage, quiet, save } from "./browser.mjs";

const mostBytes = 1.5e6; // of all files, packed with gzip

let folder; // a copy of the page that tests may change
let session;
before(async () => {
  folder = await mkdtemp(join(tmpdir(), "substep-dist-"));
  await cp(distFolder(), folder, { recursive: true });
  session = await open({ dist: folder });
});
after(async () => {
  await session?.close();
  await rm(folder, { recursive: true });
});

const running = (page) => page.waitForFunction(() => window.substep, null, { timeout: 60000 });

test("all files together are small", async () => {
  const { gzip } = total(await measure(folder));
  assert.ok(gzip > 1e5 && gzip < mostBytes, `${gzip} bytes`);
});

test("no file asks for anything outside its folder", async () => {
  const page = await openPage(session);
  const requests = [];
  page.on("request", (request) => requests.push(request.url()));
  await page.reload();
  await running(page);
  assert.ok(requests.length > 5);
  // Below the sub-path: it works from any folder of any server.
  for (const url of requests) assert.ok(url.startsWith(session.address), url);
  await page.context().close();
});

test("a download that fails can be tried again", async () => {
  const page = await openPage(session, { before: "1", fragment: "scene=bridge" });
  await page.route(/engine\.wasm/, (route) => route.abort());
  await page.reload();
  await page.locator(".substep-card button").waitFor();
  assert.match(await page.locator(".substep-card p").innerText(), /engine\.wasm.*network/);
  await save(page, "load-failed");
  await page.unroute(/engine\.wasm/);
  await page.locator(".substep-card button").click();
  await running(page);
  assert.equal((await call(page, "report")).scene, "bridge");
  await page.context().close();
});

test("progress is shown while the program comes", async () => {
  const page = await openPage(session, { before: "1" });
  await page.route(/engine\.data/, async (route) => {
    await new Promise((done) => { setTimeout(done, 1500); });
    await route.continue();
  });
  await page.reload();
  await page.waitForFunction(() => document.querySelector(".substep-card progress")?.value > 0.5);
  await save(page, "loading");
  await running(page);
  assert.ok(await page.locator(".substep-overlay").isHidden());
  await page.context().close();
});

test("what was loaded once works without a network, and a new version replaces it", async () => {
  const page = await openPage(session, { offline: true });
  await page.evaluate(() => navigator.serviceWorker.ready);
  const version = () => page.evaluate(() => caches.keys().then((names) => names.sort().join()));
  const old = await version();
  assert.match(old, /^substep .*some\/path\/ [0-9a-f]{16}$/);

  session.server.close();
  session.server.closeAllConnections();
  await page.goto(`${session.address}#scene=bridge&mode=none`);
  await page.reload();
  await running(page);
  await drawn(page);
  assert.equal((await call(page, "report")).scene, "bridge");
  await page.goto(`${session.address}example/article.html`);
  await page.waitForFunction(() => window.laboratories, null, { timeout: 60000 });

  // A new version: another file, another hash in the list.
  const port = new URL(session.address).port;
  await new Promise((done) => { session.server.listen(Number(port), "127.0.0.1", done); });
  const worker = join(folder, "service_worker.js");
  const script = await readFile(worker, "utf8");
  await writeFile(worker, script.replace(/version = "[0-9a-f]+"/, 'version = "0123456789abcdef"'));
  const index = join(folder, "index.html");
  await writeFile(index, (await readFile(index, "utf8")).replace("<title>", "<title>New "));
  await page.goto(session.address);
  await page.waitForFunction(async () => {
    const names = await caches.keys();
    return names.length === 1 && names[0].endsWith("0123456789abcdef");
  }, null, { timeout: 30000 });
  await page.goto("about:blank");
  await page.goto(session.address);
  await running(page);
  assert.match(await page.evaluate(() => fetch("./").then((r) => r.text())), /<title>New /);
  await page.context().close();
});

test("a tab in the background builds no backlog", async () => {
  const page = await openPage(session, { fragment: "scene=swinging_box" });
  // As browsers do with a tab that is not seen: no pictures for a minute, by its own clock.
  await page.evaluate(() => {
    window.realRequest = window.requestAnimationFrame;
    window.waiting = [];
    window.requestAnimationFrame = (draw) => window.waiting.push(draw);
  });
  await page.waitForTimeout(1000);
  const before = (await call(page, "report")).time;
  const after = await page.evaluate(() => {
    const start = performance.now();
    const now = performance.now.bind(performance);
    performance.now = () => now() + 60000;
    window.requestAnimationFrame = (draw) => window.realRequest.call(window, () => draw(performance.now()));
    for (const draw of window.waiting.splice(0)) draw(performance.now());
    return { time: window.substep.report().time, took: now() - start };
  });
  assert.ok(after.time - before <= 0.11, `${after.time - before} s were made up for`);
  assert.ok(after.took < 2000, `${after.took} ms`);
  quiet(page);
  await page.context().close();
});
