// Shared by the browser tests and the screenshots: a server, a browser, a page that must not log
// warnings, and its pictures.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { cp, mkdir, mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";
import { chromium } from "playwright-core";
import { PNG } from "pngjs";
import { serve } from "../../web/serve.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");

/** The folder of the built page: the first argument, SUBSTEP_WEB_DIST, or the build folder of ./dev. */
export function distFolder() {
  const folder = resolve(process.argv[2] ?? process.env.SUBSTEP_WEB_DIST ?? join(root, "build/web/dist"));
  if (!existsSync(join(folder, "engine.wasm"))) {
    console.error(`There is no built page in ${folder}: ./dev web makes it.`);
    process.exit(2);
  }
  return folder;
}

/** Whether a suite tries all its cases: by night. */
export const all = process.argv[3] === "all";

export const screenshots = process.env.SUBSTEP_SCREENSHOTS ?? join(root, "build/artefacts/screenshots");

export function chromiumPath() {
  const candidates = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser",
    "/usr/bin/google-chrome"];
  const found = candidates.find((path) => path && existsSync(path));
  if (!found) throw new Error("no Chromium: set CHROMIUM to its path");
  return found;
}

/** Flags of a browser that renders in software and makes no requests of its own. */
export const renderer = ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync"];

/**
 * A browser with a software renderer, and a server of a copy of the page below a sub-path.
 * @param options {rate}: the most pictures a second, of tests that do not look at motion
 * @returns {browser, server, folder, address, close}; folder is the copy, which a test may change
 */
export async function open({ rate } = {}) {
  const root = await mkdtemp(join(tmpdir(), "substep-web-"));
  const folder = join(root, "some/path");
  await cp(distFolder(), folder, { recursive: true });
  const server = await serve(root, 0);
  const browser = await chromium.launch({
    executablePath: chromiumPath(),
    args: renderer,
  });
  return {
    browser,
    server,
    folder,
    rate,
    free: [], // tabs
    address: `http://127.0.0.1:${server.address().port}/some/path/`,
    async close() {
      await browser.close();
      server.close();
      server.closeAllConnections();
      await rm(root, { recursive: true });
    },
  };
}

/** The state that the page stores after a visit that went from the first screen to the Lab. */
function leftFirstScreen() {
  try {
    localStorage.setItem("substep.introduction", "seen");
    if (localStorage.getItem("substep.arrangement") === null) {
      localStorage.setItem("substep.arrangement", "level=lab");
    }
  } catch { /* about:blank has no storage */ }
}

/**
 * In the page: it draws at most so many pictures a second. A software renderer takes all processors
 * if it draws as many as it can, also from the tests that run beside this one.
 */
function drawAtMost(rate) {
  const [next, cancel] = [window.requestAnimationFrame, window.cancelAnimationFrame];
  const later = new Map(); // the current request of one that was put off
  let frame = 0; // of the browser [ms]
  let drawn = 0; // the last one that was not skipped [ms]
  window.requestAnimationFrame = (draw) => {
    const id = next(function tick(now) {
      if (now !== frame && now - drawn > 1000 / rate) drawn = now;
      frame = now;
      if (now !== drawn) {
        later.set(id, next(tick));
      } else {
        later.delete(id);
        draw(now);
      }
    });
    return id;
  };
  window.cancelAnimationFrame = (id) => cancel(later.get(id) ?? id);
}

/** @param options of openPage() */
async function makeTab(session, { touch, ratio, first, offline, before, context }) {
  const page = await (context ?? await session.browser.newContext({
    serviceWorkers: offline ? "allow" : "block", hasTouch: touch, deviceScaleFactor: ratio,
  })).newPage();
  page.on("console", (message) => {
    // SwiftShader logs its own speed, and Playwright the requests that it blocks.
    const theirs = /GPU stall|GL Driver|blocked by Playwright/.test(message.text());
    if (["warning", "error"].includes(message.type()) && !theirs) {
      page.complaints.push(`${message.type()}: ${message.text()}`);
    }
  });
  page.on("pageerror", (error) => page.complaints.push(`exception: ${error.message}`));
  page.on("requestfailed", (request) => page.complaints.push(`failed: ${request.url()}`));
  page.on("response", (response) => {
    if (response.status() >= 400) page.complaints.push(`${response.status()}: ${response.url()}`);
  });
  if (!first) await page.addInitScript(leftFirstScreen);
  if (before) await page.addInitScript(before);
  if (session.rate) await page.addInitScript(drawAtMost, session.rate);
  return page;
}

/**
 * A page with the application running in it. It takes a tab that leave() freed, if one fits: the
 * browser keeps the compiled program in its tab, and compiling it is most of the cost of a page.
 * @param options {width, height, light, calm, path, fragment}; path: "files.json" has no
 *   laboratory. Options of the tab: {touch, ratio, first, offline, before, context}; first
 *   simulates a first visit: otherwise an earlier visit went from the first screen to the Lab;
 *   offline allows a service worker; before is a script that runs ahead of the page's own, and
 *   disables waiting
 * @returns the page; page.complaints lists what it logged as warning or error
 */
export async function openPage(session, options = {}) {
  const { width = 1280, height = 720, light, calm, path = "", fragment, ...tab } = options;
  const { touch = false, ratio = 1, first = false, ...own } = tab;
  const kind = Object.keys(own).length > 0 ? "own" : JSON.stringify([touch, ratio, first]);
  const at = session.free.findIndex((free) => free.kind === kind);
  const page = at < 0 ? await makeTab(session, { touch, ratio, first, ...own }) : session.free.splice(at, 1)[0];
  Object.assign(page, { session, kind, complaints: [] });
  await page.setViewportSize({ width, height });
  await page.emulateMedia({
    colorScheme: light ? "light" : "dark", reducedMotion: calm ? "reduce" : "no-preference",
  });
  await page.goto(`${session.address}${path}${fragment ? `#${fragment}` : ""}`);
  if (!own.before && path !== "files.json") {
    await page.waitForFunction(() => window.substep ?? window.laboratories ?? window.doctor, null, { timeout: 60000 });
  }
  return page;
}

/** Asserts that a page logged no warning or error, and frees its tab, without what it stored. */
export async function leave(page) {
  quiet(page);
  if (page.kind === "own") return page.context().close();
  await page.goto("about:blank");
  const tools = await page.context().newCDPSession(page);
  await tools.send("Storage.clearDataForOrigin",
    { origin: new URL(page.session.address).origin, storageTypes: "local_storage" });
  await tools.detach();
  return page.session.free.push(page);
}

/** Calls the page's API. */
export const call = (page, name, ...args) =>
  page.evaluate(([n, a]) => window.substep[n](...a), [name, args]);

/** Asserts that no warning or error was logged. */
export const quiet = (page) => assert.deepEqual(page.complaints, []);

/** A scene in the format of a link's scene64. */
export const packScene = (text) => deflateRawSync(text).toString("base64url");

/** Waits until a field of the report has a value. */
export const reports = (page, name, value) => page.waitForFunction(
  ([n, v]) => window.substep.report()[n] === v, [name, value], { timeout: 20000 });

/** A file dragged over the page. @param bytes a text or an array of bytes */
export const pickUp = (page, name, bytes) => page.evaluateHandle(([n, b]) => {
  const data = new DataTransfer();
  data.items.add(new File([typeof b === "string" ? b : new Uint8Array(b)], n));
  return data;
}, [name, bytes]);

/** @param dataTransfer the result of pickUp() */
export const dropPicked = (page, dataTransfer) =>
  page.dispatchEvent(".substep-view", "drop", { dataTransfer });

/** Waits until a scene was opened or refused. @param run that of the report before */
export const read = (page, run) => page.waitForFunction((last) => {
  const now = window.substep.report();
  return now.run !== last || now.trouble !== "";
}, run, { polling: 50, timeout: 20000 });

/** Drops a file on the laboratory. @param bytes a text or an array of bytes */
export async function drop(page, name, bytes) {
  const { run } = await call(page, "report");
  await dropPicked(page, await pickUp(page, name, bytes));
  await read(page, run);
}

/**
 * The position of a control, in CSS pixels of a canvas that fills the page.
 * @param label its text, or the name of a body
 * @param group the row of choices: "tabs", "Method"; "body" for a body
 */
export async function find(page, label, group) {
  let all;
  let found;
  for (let tries = 0; !found && tries < 20; ++tries) { // panels are drawn from the second picture on
    if (tries > 0) await page.waitForTimeout(100);
    all = await call(page, "widgets");
    found = all.find((w) => w.label === label && (group === undefined || w.group === group));
  }
  assert.ok(found, `there is no "${label}" among: ${all.map((w) => w.label).join(", ")}`);
  return found;
}

/** A place on a control. @param along 0 at its left end to 1 at its right one */
export const place = ({ x, y, width, height }, along = 0.5) => [x + along * width, y + height / 2];

/** Waits until a control is drawn. */
export const appears = (page, label) => page.waitForFunction(
  (name) => window.substep.widgets().some((w) => w.label === name), label,
  { polling: 100, timeout: 20000 });

/** Clicks a control by its text, and waits for the effect. */
export async function click(page, label, group) {
  await page.mouse.click(...place(await find(page, label, group)));
  await drawn(page);
}

/** Opens the menu of links, files and pictures. */
export async function openMenu(page) {
  await click(page, "share");
  await drawn(page); // it fades in
}

/** Clicks an entry of that menu: "Copy link", ... */
export async function pick(page, entry) {
  await openMenu(page);
  await page.mouse.click(...place(await find(page, entry)));
}

/** Waits until the page has drawn its new state: opening a panel takes a few frames. */
export const drawn = (page) => page.evaluate(async () => {
  const next = () => new Promise((done) => { requestAnimationFrame(done); });
  const pictures = () => [...document.querySelectorAll("canvas")].flatMap((c) => c.pictures ?? []);
  const shown = () => pictures().reduce((sum, p) => sum + p.shown, 0);
  for (let i = 0; i < 4; ++i) {
    const before = shown();
    do await next(); while (shown() === before && pictures().some((p) => p.shown < p.begun));
  }
});

/** A picture of the page or of a part of it, decoded. @param clip {x, y, width, height} */
export async function picture(page, clip) {
  return PNG.sync.read(await page.screenshot(clip ? { clip } : {}));
}

/** Saves a picture of the page, new or already taken, with the build artefacts. */
export async function save(page, name, png) {
  await mkdir(screenshots, { recursive: true });
  await writeFile(join(screenshots, `${name}.png`), png ? PNG.sync.write(png) : await page.screenshot());
}
