// The appearance of the page: node tests/web/look_test.mjs [FOLDER OF THE BUILT PAGE] [all]
// The 3D picture is compared with those in tests/web/reference, within a visible difference;
// SUBSTEP_NEW_REFERENCE=1 rewrites them. On request, pictures of the window at common sizes are
// saved with the build artefacts.
import assert from "node:assert/strict";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import pixelmatch from "pixelmatch";
import { PNG } from "pngjs";
import { all, call, drawn, leave, open, openPage, picture, save } from "./browser.mjs";
import { variance } from "./pixels.mjs";

const anew = process.env.SUBSTEP_NEW_REFERENCE === "1";
const reference = (name) => fileURLToPath(new URL(`reference/${name}.png`, import.meta.url));
// Other versions of the browser's software renderer antialias edges differently.
const allowed = 0.02; // share of visibly different pixels

let session;
before(async () => { session = await open(); });
after(() => session?.close());

/** The same state on every machine, with the camera at rest. */
async function still(page, settings, frames) {
  await call(page, "pause");
  await call(page, "set", settings);
  await call(page, "reset");
  await call(page, "step", frames);
  await page.waitForTimeout(2000); // the camera and fades
  await drawn(page);
}

for (const [scene, frames, theme] of [
  ["swinging_box", 150, "dark"], ["bridge", 90, "light"], ["heavy_stack", 60, "dark"],
]) {
  test(`${scene} looks unchanged, ${theme}`, async () => {
    const page = await openPage(session, { width: 480, height: 400, light: theme === "light", calm: true });
    await still(page, { scene, mode: "adaptive", panels: "off" }, frames);
    const now = await picture(page, { x: 0, y: 64, width: 480, height: 216 });
    await save(page, `look-${scene}`, now);
    if (anew) {
      await mkdir(new URL("reference", import.meta.url), { recursive: true });
      await writeFile(reference(scene), PNG.sync.write(now));
    }
    const then = PNG.sync.read(await readFile(reference(scene)));
    const marks = new PNG({ width: now.width, height: now.height });
    const differing = pixelmatch(then.data, now.data, marks.data, now.width, now.height,
      { threshold: 0.12 });
    if (differing > 0) await save(page, `look-${scene}-differs`, marks);
    assert.ok(differing / (now.width * now.height) < allowed, `${differing} pixels differ`);
    await leave(page);
  });
}

const windows = {
  "1280x720": { width: 1280, height: 720 },
  "1280x720-light": { width: 1280, height: 720, light: true },
  "1280x720-ratio-1.5": { width: 1280, height: 720, ratio: 1.5 },
  "1920x1080": { width: 1920, height: 1080 },
  "390x844-ratio-2": { width: 390, height: 844, ratio: 2, touch: true },
  "390x844-light": { width: 390, height: 844, ratio: 2, touch: true, light: true },
  "844x390": { width: 844, height: 390, ratio: 2, touch: true },
};
for (const [name, options] of all ? Object.entries(windows) : []) {
  test(`fills a window of ${name}`, async () => {
    const page = await openPage(session, { ...options, calm: true });
    await still(page, { scene: "bridge" }, 90);
    const { width, height, ratio = 1 } = options;
    assert.deepEqual(await page.evaluate(() => {
      const canvas = document.querySelector(".substep-view");
      const { scrollWidth, scrollHeight } = document.documentElement;
      return [canvas.width, canvas.height, scrollWidth, scrollHeight];
    }), [Math.round(width * ratio), Math.round(height * ratio), width, height]);
    assert.ok(variance(await picture(page)) > 100);
    await save(page, `window-${name}`);
    await leave(page);
  });
}
