// Follows core/docs/cluster.md on a Slurm of two nodes, and takes one of them away with its task:
//   tests/cluster/two_nodes.sh node tests/cluster/lost_node_test.mjs build/release/bin/substep
// Job file and commands are those of the page. At the end the results are those of the same sweep
// without a cluster: the same runs, equal in all but their times.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { fileURLToPath } from "node:url";

const own = path.dirname(fileURLToPath(import.meta.url));
const work = path.join(path.dirname(process.env.SLURM_CONF), "work");
const end = Date.now() + 50 * 60e3; // before the time limit of CTest, which would leave Slurm running
process.env.PATH = `${path.dirname(path.resolve(process.argv[2]))}:${process.env.PATH}`;

// ------------------------------------------------------------------------------------------- helpers
/** What commands print, run in a folder of `work`. */
function shell(commands, folder = "shared") {
  return execFileSync("bash", ["-euo", "pipefail", "-c", commands], {
    cwd: path.join(work, folder),
    encoding: "utf8",
    stdio: ["ignore", "pipe", "inherit"],
    timeout: Math.max(1, end - Date.now()),
  }).trim();
}

async function until(what, milliseconds, condition) {
  while (!condition()) {
    assert(Date.now() < end, `this did not happen: ${what}`);
    await sleep(milliseconds);
  }
}

/** The results in a file, one per line; an incomplete last line does not count. */
function results(folder, file) {
  const name = path.join(work, folder, file);
  if (!existsSync(name)) return [];
  return readFileSync(name, "utf8").split("\n").slice(1, -1); // the first line names the format
}

/** The sweep that runs on a node. No program is called: that could take longer than the sweep. */
function sweepOn(node) {
  for (const pid of readdirSync("/proc").filter(name => /^\d+$/.test(name))) {
    try {
      if (readFileSync(`/proc/${pid}/comm`, "utf8") !== "substep\n") continue;
      const environment = readFileSync(`/proc/${pid}/environ`, "utf8").split("\0");
      const value = name => environment.find(entry => entry.startsWith(`${name}=`))?.slice(name.length + 1);
      if (value("SLURM_CONF") !== process.env.SLURM_CONF || value("SLURMD_NODENAME") !== node) continue;
      return { pid: Number(pid), task: value("SLURM_ARRAY_TASK_ID") };
    } catch {
      // It has ended.
    }
  }
  return undefined;
}

/** @returns false if the process has ended */
function signal(pid, name) {
  try {
    return process.kill(pid, name);
  } catch {
    return false;
  }
}

function withoutTimes(line) {
  const { timing, ...rest } = JSON.parse(line);
  return rest;
}

const submitted = text => /^Submitted batch job (\d+)$/m.exec(text)[1];
const queueIsEmpty = () => shell("squeue --noheader") === "";

// ------------------------------------------------------------------------------------------ the page
const page = readFileSync(path.join(own, "../../core/docs/cluster.md"), "utf8");
const blocks = [...page.matchAll(/^```bash\n(.*?)^```$/gms)].map(match => match[1]);
assert.equal(blocks.length, 4, "blocks of the page: job file, submit, merge, submit some again");
const [job, submit, merge, submitAgain] = blocks;
const sweepLine = /^substep sweep .* --out (\S+).*( --shard \S+\/(\d+)")$/m.exec(job);
assert(sweepLine, "the job file has a line: substep sweep ... --out FOLDER ... --shard \".../N\"");
const [sweep, out, shard, parts] = sweepLine;
const log = task => /^#SBATCH --output=(\S+)$/m.exec(job)[1].replace("%a", task);
const failing = /--array=([\d,]+)/.exec(submitAgain)[1].split(",");

// --------------------------------------------------------------------------------- without a cluster
mkdirSync(path.join(work, "alone"), { recursive: true });
mkdirSync(path.join(work, "shared"));
shell(sweep.replace(shard, ""), "alone");
const expected = results("alone", `${out}/results.jsonl`);
console.log(`without a cluster: ${expected.length} runs`);

// ---------------------------------------------------------------------------------------- the array
writeFileSync(path.join(work, "shared", "sweep.sbatch"), job);
const id = submitted(shell(submit));
// Two tasks end without results, as if they had failed.
shell(`scancel ${failing.map(task => `${id}_${task}`).join(" ")}`);

// A task is stopped when it has some results, so that it cannot end before its node is lost.
const finished = task => results("shared", `${out}/results.${task}-of-${parts}.jsonl`);
let lost;
let looks = 0;
await until("a task on n2 has some results", 50, () => {
  if (++looks % 200 === 0 && queueIsEmpty()) assert.fail(`no task was seen at work:\n${shell("tail *.log")}`);
  const { pid, task } = sweepOn("n2") ?? {};
  if (!task || finished(task).length < 3 || !signal(pid, "SIGSTOP")) return false;
  if (finished(task).length < Math.floor(expected.length / parts)) lost = task;
  else signal(pid, "SIGCONT"); // it has all of its results
  return lost;
});
shell(`"${own}/two_nodes.sh" --lose n2`);
assert(!sweepOn("n2"), "n2 is not lost");
const kept = finished(lost);
console.log(`n2 is lost with task ${lost}, which had ${kept.length} results`);

await until("the array ends", 2000, queueIsEmpty);
const [, restarts] = / Restarts=(\d+) /.exec(shell(`scontrol show job ${id}_${lost}`));
assert(Number(restarts) > 0, `Slurm did not queue task ${lost} again`);
const text = readFileSync(path.join(work, "shared", log(lost)), "utf8");
const [, present, planned] = /^(\d+) of (\d+) runs are already present$/m.exec(text) ?? [];
assert.equal(Number(present), kept.length, `task ${lost} did not continue from its results:\n${text}`);
assert(kept.length < Number(planned), "the task was lost when all its runs were done: nothing was lost");
console.log(`task ${lost} was queued again and continued: ${present} of ${planned} runs were present`);

// -------------------------------------------------------------------- merge, and what is missing again
/** The two numbers of the page: runs that there are, and runs of the sweep. */
function merged() {
  const lines = shell(merge).split("\n");
  return [parseInt(lines[0], 10), Number(lines.at(-1))];
}
const [some, all] = merged();
assert.equal(all, expected.length);
assert(some < all, "the page's numbers show that runs are missing");
console.log(`merged: ${some} of ${all} runs; tasks ${failing} are submitted again`);
submitted(shell(submitAgain));
await until("the second array ends", 2000, queueIsEmpty);
assert.deepEqual(merged(), [all, all]);

const found = results("shared", `${out}/results.jsonl`);
assert.equal(found.length, expected.length);
expected.forEach((line, i) => assert.deepEqual(withoutTimes(found[i]), withoutTimes(line)));
kept.forEach(line => assert(found.includes(line), `a finished run was lost: ${line}`));
console.log(`merged: ${found.length} runs, all as without a cluster`);
