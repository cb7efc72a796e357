// One run of one engine in its own process: node run.mjs ENGINE SCENE.json FRAMES WARM_UP SETTING
// prints one line per frame, like substep_peer: milliseconds of physics, all poses, all velocities.

import { broken } from "./measures.mjs";
import { readScene } from "./scene.mjs";

const [engine, path, frames, warmUp, settingText] = process.argv.slice(2);
const { build } = await import(`./${engine}.mjs`);
const scene = readScene(path);
const setting = JSON.parse(settingText);

/** Warm-up in a separate world: afterwards code is compiled and memory is allocated. */
async function warm() {
  const kEnough = 5e3; // maximum duration [ms]
  const world = await build(scene, setting);
  const start = performance.now();
  for (let i = 0; i < Number(warmUp) && performance.now() - start < kEnough; ++i) {
    for (let k = 0; k < world.steps; ++k) world.step();
  }
  world.free();
}

/**
 * Milliseconds of some steps. If they take longer than a time slice the wall clock may include other
 * processes; the CPU time of this process is then more accurate.
 */
function timed(world, steps) {
  const kSlice = 1.0; // [ms]
  const cpu = process.cpuUsage();
  const start = performance.now();
  for (let i = 0; i < steps; ++i) world.step();
  const wall = performance.now() - start;
  if (wall < kSlice) return wall;
  const { user, system } = process.cpuUsage(cpu);
  return Math.min(wall, (user + system) / 1e3);
}

await warm();
const world = await build(scene, setting);
const lines = [];

/** Ends a frame after the first step of the next one: its velocities are those at its poses. */
function finish({ milliseconds, poses, velocities }) {
  const next = world.velocities();
  const synchronised = velocities.map((v, i) => v + world.lag * (next[i] - v));
  lines.push([milliseconds, ...poses, ...synchronised].join(" "));
}

let last = null;
for (let i = 1; i <= Number(frames); ++i) {
  let milliseconds = timed(world, 1);
  if (last) finish(last);
  if (world.steps > 1) milliseconds += timed(world, world.steps - 1);
  last = { milliseconds, poses: world.poses(), velocities: world.velocities() };
  // A failed run may end. Checked rarely, so as not to disturb the timing.
  if (i % 60 === 0 && broken(scene, last.poses)) break;
}
if (!broken(scene, last.poses)) world.step();
finish(last);
process.stdout.write(lines.join("\n") + "\n");
