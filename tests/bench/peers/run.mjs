// One run of one engine, in a process of its own: node run.mjs ENGINE SCENE.json FRAMES WARM_UP SETTING
// prints what substep_peer prints, a line a frame: milliseconds of physics, then all poses.

import { broken } from "./measures.mjs";
import { readScene } from "./scene.mjs";

const [engine, path, frames, warmUp, settingText] = process.argv.slice(2);
const { build } = await import(`./${engine}.mjs`);
const scene = readScene(path);
const setting = JSON.parse(settingText);

/** A first world, thrown away: the engine's code is compiled and its memory has its size. */
async function warm() {
  const kEnough = 5e3; // whatever is slower than this is warm [ms]
  const world = await build(scene, setting);
  const start = performance.now();
  for (let i = 0; i < Number(warmUp) && performance.now() - start < kEnough; ++i) world.step();
  world.free();
}

/**
 * Milliseconds of one frame of physics. Where others have the processor in between, in frames
 * longer than their turn, the wall clock tells of them: the time this process had is then nearer.
 */
function timed(world) {
  const kTurn = 1.0; // [ms]
  const cpu = process.cpuUsage();
  const start = performance.now();
  world.step();
  const wall = performance.now() - start;
  if (wall < kTurn) return wall;
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
  // What has failed need not run on. Seldom asked, so that it disturbs no timing.
  if (i % 60 === 0 && broken(scene, poses)) break;
}
process.stdout.write(lines.join("\n") + "\n");
