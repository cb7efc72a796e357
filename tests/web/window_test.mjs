// The native window on a virtual display: node tests/web/window_test.mjs PROGRAM
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { PNG } from "pngjs";
import { difference, part, variance } from "./pixels.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const program = resolve(process.argv[2] ?? join(root, "build/release/bin/substep-native"));
const folder = process.env.SUBSTEP_SCREENSHOTS ?? join(root, "build/artefacts/screenshots");
mkdirSync(folder, { recursive: true });

/** Runs the window for some frames and returns its last picture. */
function shot(name, ...args) {
  const path = join(folder, `native-${name}.png`);
  const result = spawnSync("xvfb-run", ["-a", "-s", "-screen 0 2600x1500x24", program,
    "--screenshot", path, ...args], { encoding: "utf8", timeout: 120000 });
  assert.equal(result.status, 0, `${result.stderr}${result.error ?? ""}`);
  return PNG.sync.read(readFileSync(path));
}

const view = { x: 300, y: 80, width: 650, height: 520 };
const plots = { x: 980, y: 50, width: 280, height: 330 };

test("opens, draws the scene, and its plots move", () => {
  const args = ["--scene", "swinging_box", "--size", "1280x720"];
  const early = shot("early", ...args, "--frames", "5");
  const late = shot("late", ...args, "--frames", "60");
  assert.deepEqual([late.width, late.height], [1280, 720]);
  assert.ok(variance(part(late, view)) > 120, "the picture is blank");
  assert.ok(difference(part(early, view), part(late, view)) > 0.005, "the box does not swing");
  assert.ok(difference(part(early, plots), part(late, plots)) > 0.005, "the plots do not move");
});

test("is sharp with a pixel ratio of 2", () => {
  const picture = shot("ratio-2", "--size", "1000x640", "--scale", "2", "--frames", "5",
    "--link", "scene=heavy_stack&theme=light");
  assert.deepEqual([picture.width, picture.height], [2000, 1280]);
  assert.ok(variance(picture) > 120);
  const brightness = picture.data.reduce((sum, value) => sum + value, 0) / picture.data.length;
  assert.ok(brightness > 180, `${brightness}: the theme of the link`);
});

test("reports invalid arguments", () => {
  for (const args of [["--scene", "no_such_scene"], ["--alpha", "7"], ["--size", "big"]]) {
    const result = spawnSync("xvfb-run", ["-a", program, ...args, "--screenshot", "/dev/null",
      "--frames", "1"], { encoding: "utf8", timeout: 60000 });
    assert.notEqual(result.status, 0, args.join(" "));
    assert.notEqual(result.stderr + result.stdout, "", args.join(" "));
  }
});
