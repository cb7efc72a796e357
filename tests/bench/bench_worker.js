// The worker in which compare.mjs runs bench_twin.js, from the same folder: posts what it prints, and
// its exit status. It is a file because the policy of web/serve.mjs forbids workers of other sources.
self.Module = {
  arguments: ["scenes"],
  print: (line) => postMessage({ line }),
  printErr: (line) => postMessage({ error: line }),
  onExit: (status) => postMessage({ status }),
};
importScripts("bench_twin.js");
