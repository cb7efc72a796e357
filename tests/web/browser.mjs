// What the browser tests and the screenshots share: a server, a browser, a page that must not
// complain, and its pictures.
import { existsSync } from "node:fs";
import { mkdir, mkdtemp, rm, symlink, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { PNG } from "pngjs";
import { serve } from "../../web/serve.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");

/** The folder of the built page: the first argument, SUBSTEP_WEB_DIST, or where ./dev builds it. */
export function distFolder() {
  const folder = resolve(process.argv[2] ?? process.env.SUBSTEP_WEB_DIST ?? join(root, "build/web/dist"));
  if (!existsSync(join(folder, "substep.wasm"))) {
    console.error(`There is no built page in ${folder}: ./dev web makes it.`);
    process.exit(2);
  }
  return folder;
}

export const screenshots = process.env.SUBSTEP_SCREENSHOTS ?? join(root, "build/artefacts/screenshots");

function chromiumPath() {
  const candidates = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser",
    "/usr/bin/google-chrome"];
  const found = candidates.find((path) => path && existsSync(path));
  if (!found) throw new Error("no Chromium: set CHROMIUM to its path");
  return found;
}

/** A browser with a software renderer, and a server of the page below a sub-path. */
export async function open() {
  const folder = await mkdtemp(join(tmpdir(), "substep-web-"));
  await mkdir(join(folder, "some"));
  await symlink(distFolder(), join(folder, "some/path"));
  const server = await serve(folder, 0);
  const browser = await chromium.launch({
    executablePath: chromiumPath(),
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-quic", "--no-first-run",
      "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
  return {
    browser,
    address: `http://127.0.0.1:${server.address().port}/some/path/`,
    async close() {
      await browser.close();
      server.close();
      await rm(folder, { recursive: true });
    },
  };
}

/**
 * A page with the application running in it.
 * @param options {width, height, ratio, fragment, light, touch, before}; before is a script that
 *   runs ahead of the page's own, and then nothing is waited for
 * @returns the page; page.complaints lists what it logged as warning or error
 */
export async function openPage(session, options = {}) {
  const context = await session.browser.newContext({
    viewport: { width: options.width ?? 1280, height: options.height ?? 720 },
    deviceScaleFactor: options.ratio ?? 1,
    colorScheme: options.light ? "light" : "dark",
    hasTouch: options.touch ?? false,
  });
  const page = await context.newPage();
  page.complaints = [];
  page.on("console", (message) => {
    // SwiftShader talks about its own speed.
    if (["warning", "error"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) {
      page.complaints.push(`${message.type()}: ${message.text()}`);
    }
  });
  page.on("pageerror", (error) => page.complaints.push(`exception: ${error.message}`));
  page.on("requestfailed", (request) => page.complaints.push(`failed: ${request.url()}`));
  page.on("response", (response) => {
    if (response.status() >= 400) page.complaints.push(`${response.status()}: ${response.url()}`);
  });
  if (options.before) await page.addInitScript(options.before);
  await page.goto(`${session.address}${options.fragment ? `#${options.fragment}` : ""}`);
  if (!options.before) await page.waitForFunction(() => window.substep, null, { timeout: 60000 });
  return page;
}

/** Waits until the page has drawn what it was told: a panel that opens takes a few frames. */
export const drawn = (page) => page.evaluate(async () => {
  for (let i = 0; i < 4; ++i) await new Promise((done) => { requestAnimationFrame(done); });
});

/** A picture of the page or of a part of it, decoded. @param clip {x, y, width, height} */
export async function picture(page, clip) {
  return PNG.sync.read(await page.screenshot(clip ? { clip } : {}));
}

/** Keeps a picture of the page, a new one or one taken already, among the build's artefacts. */
export async function save(page, name, png) {
  await mkdir(screenshots, { recursive: true });
  await writeFile(join(screenshots, `${name}.png`), png ? PNG.sync.write(png) : await page.screenshot());
}
