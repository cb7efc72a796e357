// The examples of the pages that are not run, or not every day: the one list of them. An entry names the
// page and the example as printed, a command without its comment or the first line of a block (or, with
// kind, every example of a kind), and one of
//   notRun: why the example is not run
//   night:  why it is run by night only
// Every other example is run; an entry without an example is an error.

const tried = "commands_test.mjs runs it in its shortest form";
const labels = "./dev test runs these tests";
const formula = "a formula";
const pattern = "a pattern, with names of the reader's own";
const cluster = "tests/cluster/lost_node_test.mjs runs all of them, on a Slurm of its own";
const sweep = "a sweep takes minutes";
const night = "takes minutes";

export const exceptions = [
  { page: ".github/actions/doctor/README.md", code: "- uses: actions/checkout@v4", notRun: "GitHub runs it" },

  { page: "README.md", code: "./dev run", notRun: tried },
  { page: "README.md", code: "./dev test", notRun: labels },
  { page: "README.md", code: "./dev cli reproduce", night },
  { page: "README.md", code: "./dev cli exam", night },

  { page: "core/README.md", code: "./dev cli recommend swinging_box --error 1e-3", night: sweep },

  { page: "core/docs/cluster.md", code: "substep sweep --shard i/n", notRun: pattern },
  { page: "core/docs/cluster.md", kind: "script", notRun: cluster },
  { page: "core/docs/cluster.md", code: "substep merge b check/results.3-of-8.jsonl", notRun: pattern },

  { page: "core/docs/modes.md", code: "Mt u+ = (beta Mt + (1 - beta) M) u - dt k x,    x+ = x + dt u+",
    notRun: formula },
  { page: "core/docs/solvers.md", code: "w = J u+ + softness * impulse + bias,    lo <= impulse <= hi",
    notRun: formula },
  { page: "core/docs/solvers.md", code: "w = 0 between the bounds,  w >= 0 at lo,  w <= 0 at hi",
    notRun: formula },

  { page: "core/lab/README.md", code: "substep sweep swinging_box", night: sweep },
  { page: "core/lab/README.md", code: "substep recommend bridge --of gap", night: sweep },
  { page: "core/lab/README.md", code: "substep recommend swinging_box --ms 0.05", night: sweep },
  { page: "core/lab/README.md", code: "substep recommend my.json --out my.json", night: sweep },
  { page: "core/lab/README.md", code: "substep reproduce", night },
  { page: "core/lab/README.md", code: "substep exam", night },
  { page: "core/lab/README.md", code: "substep check --all", night },
  { page: "core/lab/README.md", code: "./dev sweeps", notRun: tried },
  { page: "core/lab/README.md", code: "parallel substep sweep bridge --out b --jobs 1 --shard {}/4 ::: 1 2 3 4",
    night: sweep },
  { page: "core/lab/README.md",
    code: "seq 4 | xargs -P 4 -I{} substep sweep bridge --out b --jobs 1 --shard {}/4", night: sweep },
  { page: "core/lab/README.md", code: "substep merge b", night: "needs the sweep before it" },
  { page: "core/lab/README.md", code: "substep run --experiments", notRun: "a flag, not a whole command" },
  { page: "core/lab/README.md", code: "substep sweep bridge --list | parallel --pipe -N8 substep run " +
      "--experiments - > more.jsonl", night: sweep },
  { page: "core/lab/README.md", code: "substep merge b more.jsonl", night: "needs the sweep before it" },
  { page: "core/lab/README.md",
    code: "ls list.* | xargs -P 2 -I{} sh -c 'substep run --experiments {} > {}.jsonl'", night: sweep },
  { page: "core/lab/README.md", code: "substep merge b list.*.jsonl", night: "needs the sweep before it" },

  { page: "scenes/README.md", code: "substep recommend my_scene.json --error 1e-3 --out my_scene.json",
    night: sweep },
  { page: "scenes/README.md",
    code: "build/release/bin/substep recommend --all --out scenes/generator/recommended.json", night },
  { page: "scenes/README.md", code: "substep check --all", night },
  { page: "scenes/README.md", code: "substep check --hard", night },
  { page: "scenes/hard_set.md", code: "substep check --hard", night },

  { page: "tests/bench/README.md", code: "./dev bench", notRun: tried },
  { page: "tests/bench/README.md", code: "./dev bench --rounds 1 --benchmark_filter=bridge", notRun: tried },
  { page: "tests/bench/README.md", code: "./dev bench --peers", notRun: tried },
  { page: "tests/bench/README.md", code: "./dev cli sweep swinging_box", night: sweep },
  { page: "tests/bench/README.md", code: "substep recommend swinging_box --error 1e-3", night: sweep },
  { page: "tests/bench/peers/README.md", code: "./dev bench --peers", notRun: tried },
  { page: "tests/bench/peers/README.md",
    code: "./dev bench --peers --scene bridge --engine mujoco --engine wasm --repeats 5", notRun: tried },
  { page: "tests/bench/peers/README.md", code: "./dev bench --peers --scene crane --settings 3",
    notRun: tried },

  { page: "tests/paper/README.md", code: "./dev test paper", notRun: labels },
  { page: "tests/paper/README.md", code: "./dev cli reproduce", night },
  { page: "tests/paper/README.md", code: "./dev cli exam", night },
  { page: "tests/paper/README.md", code: "./dev cli check --all", night },
  { page: "tests/paper/README.md", code: "./dev cli check --hard", night },
  { page: "tests/paper/README.md", code: "substep exam --case compliant_ball", night },
  { page: "tests/paper/README.md", code: "substep check --hard", night },
  { page: "tests/paper/README.md",
    code: "substep map --out scenes/stability_map.csv --picture scenes/stability_map.svg", night },

  { page: "substep --help", code: "substep sweep swinging_box", night: sweep },
  { page: "substep --help", code: "substep check --all", night },
  { page: "substep check --help", code: "substep check swinging_box bridge", night },
  { page: "substep merge --help", code: "substep merge bridge.sweep", notRun: pattern },
  { page: "substep recommend --help", code: "substep recommend swinging_box --error 1e-4", night: sweep },
  { page: "substep recommend --help", code: "substep recommend bridge --of gap --error 1e-3", night: sweep },
  { page: "substep recommend --help", code: "substep recommend swinging_box --ms 0.05", night: sweep },
  { page: "substep recommend --help",
    code: "substep recommend my_scene.json --error 1e-3 --out my_scene.json", night: sweep },
  { page: "substep run --help", code: "substep sweep bridge --list | parallel --pipe -N4 substep run " +
      "--experiments - > bridge.jsonl", night: sweep },
  { page: "substep sweep --help", code: "substep sweep swinging_box", night: sweep },
  { page: "substep sweep --help", code: "substep sweep bridge --seconds 2 --iterations 50 --out bridge_50",
    night: sweep },
  { page: "substep sweep --help", code: "parallel substep sweep bridge --out b --jobs 1 --shard {}/4 ::: " +
      "1 2 3 4; substep merge b", night: sweep },

  { page: "web/README.md", code: "node tests/web/malice_test.mjs build/web/dist all", night },
];
