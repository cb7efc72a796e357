// One run of one engine in its own process: node run.mjs ENGINE SCENE.json FRAMES WARM_UP SETTING
// prints one line per frame, like substep_peer: milliseconds of physics, then all poses.

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
  for (let i = 0; i < Number(warmUp) && performance.now() - start < kEnough; ++i) world.step();
  world.free();
}

/**
 * Milliseconds of one frame of physics. In a frame longer than a time slice the wall clock may include
 * other processes; the CPU time of this process is then more accurate.
 */
function timed(world) {
  const kSlice = 1.0; // [ms]
  const cpu = process.cpuUsage();
  const start = performance.now();
  world.step();
  const wall = performance.now() - start;
  if (wall < kSlice) return wall;
  const { user, system } = process.cpuUsage(cpu);
  return Math.min(wall, (user + system) / 1e3);
}

await warm();
const world = await build(scene, setting);
const lines = [];
for (let i = 1; i <= Number(frames); ++i) {
  const milliseconds = timed(world);
  const poses = world.poses();
  lines.push([milliseconds, ...poses].join(" "));
  // A failed run may end. Checked rarely, so as not to disturb the timing.
  if (i % 60 === 0 && broken(scene, poses)) break;
}
process.stdout.write(lines.join("\n") + "\n");
