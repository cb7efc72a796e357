#!/usr/bin/env node
// Download sizes of a visit: node web/sizes.mjs FOLDER. Also a module: measure(folder).
import { readdir, readFile } from "node:fs/promises";
import { join, relative } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";

/** The files of a folder, largest first: {name, plain, gzip, brotli} in bytes. */
export async function measure(folder) {
  const files = [];
  for (const entry of await readdir(folder, { recursive: true, withFileTypes: true })) {
    if (!entry.isFile()) continue;
    const path = join(entry.parentPath ?? entry.path, entry.name);
    const bytes = await readFile(path);
    files.push({ name: relative(folder, path), plain: bytes.length,
      gzip: gzipSync(bytes, { level: 9 }).length, brotli: brotliCompressSync(bytes).length });
  }
  return files.sort((a, b) => b.plain - a.plain);
}

/** Sums over all files. */
export const total = (files) => files.reduce((sum, file) => ({ name: "all files",
  plain: sum.plain + file.plain, gzip: sum.gzip + file.gzip, brotli: sum.brotli + file.brotli }));

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const files = await measure(process.argv[2]);
  const small = files.slice(4);
  const rows = [...files.slice(0, 4), { ...total(small), name: `${small.length} more` }, total(files)];
  const column = (bytes) => `${(bytes / 1000).toFixed(0)} kB`.padStart(10);
  console.log(`${"".padEnd(16)}${["plain", "gzip", "brotli"].map((t) => t.padStart(10)).join("")}`);
  for (const row of rows) {
    console.log(row.name.padEnd(16) + column(row.plain) + column(row.gzip) + column(row.brotli));
  }
}
