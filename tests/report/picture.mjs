// The README's picture of what accuracy costs: node tests/report/picture.mjs REPORT.html
import { fileURLToPath } from "node:url";
import { launch, openFile } from "./browser.mjs";

const browser = await launch();
const page = await openFile(browser, process.argv[2], { width: 1000, height: 1000, ratio: 1.5 });
const picture = page.locator(".figure").first().locator(".picture");
await picture.scrollIntoViewIfNeeded();
await picture.screenshot({ path: fileURLToPath(new URL("../../app/report/picture.png", import.meta.url)) });
await browser.close();
