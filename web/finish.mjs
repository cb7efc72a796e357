#!/usr/bin/env node
// The last step of the build: writes the files that depend on all others.
//   node web/finish.mjs SOURCE FOLDER FILE...
// The files are those of this build. Files of earlier builds are removed from the folder.
// version.mjs  sizes of the downloads, for the progress bar
// files.json  the version, a hash of all files, and their list: for service_worker.js
import { createHash } from "node:crypto";
import { copyFile, readdir, readFile, rm, stat, writeFile } from "node:fs/promises";
import { join, relative } from "node:path";

const [source, folder, ...built] = process.argv.slice(2);
const files = [...built, "version.mjs"].sort();

const sizes = {};
for (const name of ["engine.wasm", "engine.data"]) sizes[name] = (await stat(join(folder, name))).size;
await writeFile(join(folder, "version.mjs"),
  `// Written by the build.\nexport const sizes = ${JSON.stringify(sizes)};\n`);

for (const entry of await readdir(folder, { recursive: true, withFileTypes: true })) {
  const path = join(entry.parentPath ?? entry.path, entry.name);
  if (entry.isFile() && !files.includes(relative(folder, path))) await rm(path);
}
const hash = createHash("sha256");
for (const name of files) hash.update(name).update(await readFile(join(folder, name)));
// A folder is requested by its own name as well as by that of its page.
await copyFile(join(source, "service_worker.js"), join(folder, "service_worker.js"));
await writeFile(join(folder, "files.json"),
  JSON.stringify({ version: hash.digest("hex").slice(0, 16), files: ["./", ...files] }, null, 1));
