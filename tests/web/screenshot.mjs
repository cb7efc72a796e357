// Renders the README's picture: node tests/web/screenshot.mjs [FOLDER OF THE BUILT PAGE]
// The swinging box with adaptive sub-steps, a moment after its lowest point, at a pixel ratio of 1.5.
import { writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { drawn, open, openPage } from "./browser.mjs";

const path = fileURLToPath(new URL("../../web/picture.png", import.meta.url));
const session = await open();
try {
  const page = await openPage(session, {
    width: 1280, height: 720, ratio: 1.25, fragment: "scene=swinging_box&mode=adaptive&alpha=0.1",
  });
  await page.evaluate(() => {
    window.substep.pause();
    window.substep.reset();
    window.substep.step(570);
  });
  await page.waitForFunction(() => window.substep.report().time > 9.49);
  await page.waitForTimeout(2000); // until the picture is at its finest
  await drawn(page);
  const png = await page.screenshot();
  if (page.complaints.length > 0) throw new Error(page.complaints.join("\n"));
  await writeFile(path, png);
  console.log(`${path}: ${(png.length / 1000).toFixed(0)} kB`);
} finally {
  await session.close();
}
