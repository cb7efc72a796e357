// Shared by the browser tests and the screenshots: a server, a browser, a page that must not log
// warnings, and its pictures.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { cp, mkdir, mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
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
 * @param options {flags}: additional browser flags
 * @returns {browser, server, folder, address, close}; folder is the copy, which a test may change
 */
export async function open({ flags = [] } = {}) {
  const root = await mkdtemp(join(tmpdir(), "substep-web-"));
  const folder = join(root, "some/path");
  await cp(distFolder(), folder, { recursive: true });
  const server = await serve(root, 0);
  const browser = await chromium.launch({
    executablePath: chromiumPath(),
    args: [...renderer, ...flags],
  });
  return {
    browser,
    server,
    folder,
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
 * A page with the application running in it.
 * @param options {width, height, ratio, fragment, light, touch, calm, context, path, before, first};
 *   before is a script that runs ahead of the page's own, and disables waiting; first simulates a
 *   first visit: otherwise an earlier visit went from the first screen to the Lab
 * @returns the page; page.complaints lists what it logged as warning or error
 */
export async function openPage(session, options = {}) {
  const context = options.context ?? await session.browser.newContext({
    serviceWorkers: options.offline ? "allow" : "block",
    reducedMotion: options.calm ? "reduce" : "no-preference",
    viewport: { width: options.width ?? 1280, height: options.height ?? 720 },
    deviceScaleFactor: options.ratio ?? 1,
    colorScheme: options.light ? "light" : "dark",
    hasTouch: options.touch ?? false,
  });
  const page = await context.newPage();
  page.complaints = [];
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
  if (options.before) await page.addInitScript(options.before);
  if (!options.first) await page.addInitScript(leftFirstScreen);
  const fragment = options.fragment ? `#${options.fragment}` : "";
  await page.goto(`${session.address}${options.path ?? ""}${fragment}`);
  if (!options.before) await page.waitForFunction(() => window.substep, null, { timeout: 60000 });
  return page;
}

/** Calls the page's API. */
export const call = (page, name, ...args) =>
  page.evaluate(([n, a]) => window.substep[n](...a), [name, args]);

/** Asserts that no warning or error was logged. */
export const quiet = (page) => assert.deepEqual(page.complaints, []);

/** Waits until a field of the report has a value. */
export const reports = (page, name, value) => page.waitForFunction(
  ([n, v]) => window.substep.report()[n] === v, [name, value], { timeout: 20000 });

/** A file dragged over the page. @param bytes a text or an array of bytes */
export const pickUp = (page, name, bytes) => page.evaluateHandle(([n, b]) => {
  const data = new DataTransfer();
  data.items.add(new File([typeof b === "string" ? b : new Uint8Array(b)], n));
  return data;
}, [name, bytes]);

/** Drops a file on the laboratory. @param bytes a text or an array of bytes */
export const drop = async (page, name, bytes) => dropPicked(page, await pickUp(page, name, bytes));

/** @param transfer the result of pickUp() */
export async function dropPicked(page, transfer) {
  await page.dispatchEvent(".substep-view", "drop", { dataTransfer: transfer });
  await page.waitForTimeout(200);
  await drawn(page);
}

/**
 * The position of a control, in CSS pixels of a canvas that fills the page.
 * @param label its text, or the name of a body
 * @param group the row of choices: "tabs", "Method"; "body" for a body
 */
export async function find(page, label, group) {
  const all = await call(page, "widgets");
  const found = all.find((w) => w.label === label && (group === undefined || w.group === group));
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
