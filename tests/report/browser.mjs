// A browser for files on disk: Chromium, driven by the package of the web tests.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const { chromium } = createRequire(new URL("../web/package.json", import.meta.url))("playwright-core");

export async function launch() {
  const path = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"]
    .find(candidate => candidate && existsSync(candidate));
  if (!path) throw new Error("no Chromium: set CHROMIUM to its path");
  return chromium.launch({ executablePath: path, args: ["--no-sandbox", "--disable-gpu"] });
}

/** Opens a file. page.complaints lists its log messages and its network requests. */
export async function openFile(browser, file, { width = 1280, height = 720, dark = false, ratio = 1 } = {}) {
  const context = await browser.newContext({
    viewport: { width, height }, colorScheme: dark ? "dark" : "light", deviceScaleFactor: ratio, acceptDownloads: true,
  });
  const page = await context.newPage();
  page.complaints = [];
  page.on("console", message => page.complaints.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", error => page.complaints.push(`exception: ${error.message}`));
  page.on("request", request => {
    if (!/^(file|data|blob):/.test(request.url())) page.complaints.push(`network: ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector(".picture svg");
  return page;
}
