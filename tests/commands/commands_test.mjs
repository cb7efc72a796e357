// Every command that ./dev help prints, in its shortest form: node tests/commands/commands_test.mjs
// [COMMAND...]. It runs for minutes, after ./dev nightly has built everything. Commands run in the
// repository, as a reader runs them; those that write into the tree run in a copy. After each command
// the tree must be as before.
import assert from "node:assert/strict";
import { appendFileSync, existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { changes, contents, copyOfTree, end, root, run, start, until } from "./shell.mjs";

// Commands of the help that are not tried here.
const kNotTried = {
  test: "builds and runs the tests, of which this is one",
  nightly: "runs this test",
};

/** Runs ./dev, which must succeed. @returns what it prints */
async function dev(args, options = {}) {
  const { status, out } = await run("./dev", args, options);
  assert.equal(status, 0, `./dev ${args.join(" ")} ends with ${status}:\n${out.slice(-4000)}`);
  return out;
}

/** Runs ./dev, which must fail. @returns what it prints */
async function devFails(args, options = {}) {
  const { status, out } = await run("./dev", args, options);
  assert.equal(status, 1, `./dev ${args.join(" ")} ends with ${status}:\n${out.slice(-4000)}`);
  return out;
}

/** In a copy of the tree, with some of its build folders. */
async function inCopy(presets, trial) {
  const copy = copyOfTree(presets);
  try {
    const before = contents(copy.folder);
    await trial(copy.folder, () => changes(before, contents(copy.folder)));
  } finally {
    copy.remove();
  }
}

// ------------------------------------------------------------------------------------------ the window
/** The picture of a virtual screen, from the file that it writes (X window dump): its pixels. */
function pixels(file) {
  const dump = readFileSync(file);
  const field = (i) => dump.readUInt32BE(4 * i);
  const [headerSize, height, perLine, colours] = [field(0), field(5), field(12), field(19)];
  return dump.subarray(headerSize + 12 * colours, headerSize + 12 * colours + height * perLine);
}

/** The number of different pixels of four bytes, up to a limit. */
function colours(bytes, limit = 1000) {
  const seen = new Set();
  for (let i = 0; i + 4 <= bytes.length && seen.size < limit; i += 4) seen.add(bytes.readUInt32LE(i));
  return seen.size;
}

/** A virtual screen. @returns {display, folder, picture(), end()}: folder is removed at the end */
async function screen() {
  const folder = mkdtempSync(join(tmpdir(), "substep-screen-"));
  const server = start("Xvfb", ["-displayfd", "1", "-screen", "0", "1280x800x24", "-fbdir", folder,
    "-nolisten", "tcp"]);
  const number = await until("a virtual screen", () => /^(\d+)\n/m.exec(server.out)?.[1]);
  return {
    display: `:${number}`,
    folder,
    picture: () => pixels(join(folder, "Xvfb_screen0")),
    async end() {
      end(server);
      await server.done;
      rmSync(folder, { recursive: true, force: true });
    },
  };
}

// ------------------------------------------------------------------------------------------ the trials
const trials = {
  async help() {
    const out = await dev(["help"]);
    assert.match(out, /^usage: \.\/dev COMMAND/);
    assert.equal(await dev([]), out);
    assert.match(await devFails(["fly"]), /there is no command 'fly'/);
  },

  async run() {
    const server = start("./dev", ["run", "--port", "0"]);
    try {
      const address = await until("the address", () => {
        assert.ok(server.exitCode === null, `it has ended: ${server.out}`);
        return /http:\/\/localhost:\d+\//.exec(server.out)?.[0];
      }, 1200);
      const page = await fetch(address);
      assert.equal(page.status, 200);
      assert.match(await page.text(), /<title>[^<]*substep/i);
      const program = await fetch(`${address}engine.wasm`);
      assert.equal(program.status, 200);
      assert.ok(WebAssembly.validate(await program.arrayBuffer()), "engine.wasm is no WebAssembly");
    } finally {
      end(server, "SIGINT"); // as Ctrl-C
    }
    assert.equal(await server.done, 0, server.out);
  },

  async native() {
    const { display, folder, picture, end: close } = await screen();
    try {
      // The window stores its settings in XDG_CONFIG_HOME.
      const window = start("./dev", ["native"],
        { env: { DISPLAY: display, LIBGL_ALWAYS_SOFTWARE: "1", XDG_CONFIG_HOME: folder } });
      await until("a window that draws", () => {
        assert.ok(window.exitCode === null, `it has ended: ${window.out}`);
        return colours(picture()) > 200;
      }, 1200);
      end(window);
      await window.done;
    } finally {
      await close();
    }
  },

  async cli() {
    assert.match(await dev(["cli", "--help"]), /Subcommands:[^]*\brun\b/);
    assert.match(await dev(["cli", "run", "pendulum", "--seconds", "1"]), /\bholds\b/);
  },

  async bench() {
    const native = ["--benchmark_filter=^swinging_box/bpp$", "--benchmark_min_time=0.01"];
    const out = await dev(["bench", "--rounds", "1", ...native]);
    assert.match(out, /^Benchmark .* allocations per_substep$/m);
    assert.match(out, /^swinging_box\/bpp +\S+ us +\S+ us +\d+ +\S+ +\S+s$/m);
    assert.match(out, /^Node\.js v\d+.*, Chromium \d+.*: the minimum of 1 interleaved runs$/m);
    // Time natively, in Node.js and in Chromium, two ratios, and allocations.
    assert.match(out, /^swinging_box\/bpp +us per sub-step( +[\d.e+-]+){6}$/m);
    assert.match(out, /^bridge\/frame_alpha_0\.1 +ms per frame( +[\d.e+-]+){6}$/m);

    const peers = await dev(["bench", "--peers", "--scene", "crane", "--settings", "3", "--repeats", "1"]);
    for (const engine of ["substep, native", "substep, WASM", "ODE, native", "MuJoCo, WASM", "Rapier, WASM",
      "Jolt, WASM", "PhysX, WASM"]) {
      // Milliseconds per frame, and millimetres off the exact motion.
      assert.match(peers, new RegExp(`^${engine} +[\\d.e+-]+ +[\\d.e+-]+ +`, "m"));
    }
    assert.doesNotMatch(peers, /stops:/);
  },

  async web() {
    const out = await dev(["web", "--dist"]);
    assert.match(out, /^engine\.wasm +\d+ kB/m);
    const dist = join(root, "build/web/dist");
    const { files } = JSON.parse(readFileSync(join(dist, "files.json"), "utf8"));
    assert.ok(files.includes("index.html"));
    for (const file of files) assert.ok(existsSync(join(dist, file)), `${file} is missing`);
  },

  async format() {
    await dev(["format", "--check"]);
    await inCopy([], async (folder, changed) => {
      appendFileSync(join(folder, "core/math/hash.hpp"), "\nint   badly_formatted;\n");
      assert.match(await devFails(["format", "--check"], { cwd: folder }), /hash\.hpp/);
      await dev(["format"], { cwd: folder });
      assert.match(readFileSync(join(folder, "core/math/hash.hpp"), "utf8"), /^int badly_formatted;$/m);
      assert.deepEqual(changed(), ["core/math/hash.hpp"]);
    });
  },

  async lint() {
    assert.match(await dev(["lint", "core/math/free_turn.cpp"]), /^Checking 1 files/m);
  },

  async fuzz() {
    const [, list] = /fuzz a reader[^]*?:\s*([a-z, ]+) \(default/.exec(await dev(["help"]));
    const targets = list.split(/, | or /);
    assert.ok(targets.length > 1, list);
    for (const target of targets) {
      assert.match(await dev(["fuzz", target, "5"]), /^stat::number_of_executed_units: *[1-9]/m);
    }
  },

  async golden() {
    await inCopy(["release", "clang", "web"], async (folder, changed) => {
      await dev(["golden"], { cwd: folder });
      assert.deepEqual(changed(), []);
    });
  },

  async sweeps() {
    await inCopy(["release"], async (folder, changed) => {
      assert.match(await dev(["sweeps", "pendulum"], { cwd: folder }), /^pendulum$/m);
      assert.deepEqual(changed(), []);
    });
  },

  async figures() {
    await inCopy(["release"], async (folder, changed) => {
      const out = await dev(["figures"], { cwd: folder });
      assert.match(out, /^\| `crank_rocker` \| steady, alpha 0\.1 \|/m);
      assert.deepEqual(changed(), []);
    });
  },

  async docs() {
    await dev(["docs"]);
    assert.match(readFileSync(join(root, "build/docs/html/index.html"), "utf8"), /substep/);
  },
};

// ----------------------------------------------------------------------------------------------- tests
test("every command of the help is tried", async () => {
  const printed = [...(await dev(["help"])).matchAll(/^ {2}([a-z]+)\b/gm)].map((match) => match[1]);
  assert.deepEqual([...new Set(printed)].sort(), Object.keys({ ...trials, ...kNotTried }).sort());
});

const wanted = process.argv.slice(2);
for (const name of wanted) assert.ok(trials[name], `${name} is none of ${Object.keys(trials).join(" ")}`);
for (const [name, trial] of Object.entries(trials)) {
  if (wanted.length > 0 && !wanted.includes(name)) continue;
  test(`./dev ${name}`, async () => {
    const before = contents(root);
    await trial();
    assert.deepEqual(changes(before, contents(root)), [], `files changed while ./dev ${name} ran`);
  });
}
