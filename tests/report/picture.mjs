// The pictures of tests/paper/README.md: node tests/report/picture.mjs SWEEP/report.html REPRODUCTION/report.html
import { fileURLToPath } from "node:url";
import { launch, openFile } from "./browser.mjs";

const [sweep, reproduction] = process.argv.slice(2);
const browser = await launch();

async function shoot(page, title, name) {
  const picture = page.locator(".figure", { has: page.getByRole("heading", { name: title, exact: true }) }).locator(".picture");
  await picture.scrollIntoViewIfNeeded();
  await picture.screenshot({ path: fileURLToPath(new URL(`../../app/report/${name}.png`, import.meta.url)) });
}

const accuracy = await openFile(browser, sweep, { width: 1000, height: 1000, ratio: 1.5 });
await shoot(accuracy, "Error against cost", "error-against-cost");
const figures = await openFile(browser, reproduction, { width: 680, height: 1000, ratio: 1.5 });
await shoot(figures, "Swinging box, direct solver", "figure-2");
await shoot(figures, "Largest kinetic energy of every swing", "figure-3");
await shoot(figures, "Height of the heavy box, heavy_stack_stress", "figure-4");
await browser.close();
