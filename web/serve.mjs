#!/usr/bin/env node
// Serves a folder of static files on localhost only.
//   node web/serve.mjs FOLDER [--port N]
// A taken port is replaced by the next free one. Also a module: serve(folder, port).
import { createReadStream } from "node:fs";
import { realpath, stat } from "node:fs/promises";
import { createServer, STATUS_CODES } from "node:http";
import { extname, join, normalize, sep } from "node:path";
import { pathToFileURL } from "node:url";

const types = {
  ".css": "text/css",
  ".csv": "text/csv",
  ".html": "text/html",
  ".ico": "image/x-icon",
  ".js": "text/javascript",
  ".json": "application/json",
  ".mjs": "text/javascript",
  ".png": "image/png",
  ".svg": "image/svg+xml",
  ".ttf": "font/ttf",
  ".wasm": "application/wasm",
  ".webp": "image/webp",
  ".woff2": "font/woff2",
};

// Content security policy: only files of this server. Inline styles are used by the pages and the
// program; pictures and videos are created in memory.
const policy = [
  "default-src 'none'", "script-src 'self' 'wasm-unsafe-eval'", "style-src 'self' 'unsafe-inline'",
  "img-src 'self' blob: data:", "media-src 'self' blob:", "font-src 'self'", "connect-src 'self'",
  "worker-src 'self'", "base-uri 'none'", "form-action 'none'", "frame-ancestors 'self'",
].join("; ");

const everyAnswer = { "Content-Security-Policy": policy, "X-Content-Type-Options": "nosniff" };

/** The path of an address relative to the server's root: "/", "/example/article.html". */
const pathOf = (url) => decodeURIComponent(new URL(url, "http://x").pathname).replace(/^\/+/, "/");

/**
 * The file of a request, or null if it does not exist or is outside the folder.
 * @param folder without symbolic links
 */
async function find(folder, url) {
  try {
    const inside = (path) => path === folder || path.startsWith(folder.replace(/\/$/, "") + sep);
    const asked = normalize(join(folder, pathOf(url)));
    if (!inside(asked)) return null;
    const isFolder = (await stat(asked)).isDirectory();
    // The path may contain a symbolic link: the location of the file counts.
    const path = await realpath(isFolder ? join(asked, "index.html") : asked);
    const info = await stat(path);
    return inside(path) && info.isFile() ? { path, isFolder, size: info.size } : null;
  } catch {
    return null; // no such file, or an invalid address
  }
}

/** Responds without a file. */
function refuse(response, status, headers = {}) {
  response.writeHead(status, { ...everyAnswer, "Content-Type": "text/plain", ...headers });
  response.end(`${STATUS_CODES[status]}\n`);
}

async function answer(folder, request, response) {
  if (request.method !== "GET" && request.method !== "HEAD") {
    refuse(response, 405, { Allow: "GET, HEAD" });
    return;
  }
  const file = await find(folder, request.url);
  if (!file) {
    refuse(response, 404);
    return;
  }
  const path = pathOf(request.url);
  if (file.isFolder && !path.endsWith("/")) {
    // Relative addresses in the page require a trailing slash.
    refuse(response, 301, { Location: `${path.split("/").map(encodeURIComponent).join("/")}/` });
    return;
  }
  response.writeHead(200, {
    ...everyAnswer,
    "Content-Type": types[extname(file.path)] ?? "application/octet-stream",
    "Content-Length": file.size,
    "Cache-Control": "no-cache", // a rebuilt page is shown on the next reload
  });
  if (request.method === "HEAD") response.end();
  else createReadStream(file.path).on("error", () => response.destroy()).pipe(response);
}

/**
 * Starts a server for the files in a folder. Symbolic links are followed only within the folder.
 * Only GET and HEAD are supported.
 * @param port 0: any free one
 * @returns a promise of the listening server; rejected if the folder does not exist or the port is
 *   taken
 */
export async function serve(folder, port = 0) {
  const root = await realpath(folder);
  const server = createServer((request, response) => answer(root, request, response));
  return new Promise((done, fail) => {
    server.once("error", fail);
    server.listen(port, "127.0.0.1", () => done(server));
  });
}

async function main(args) {
  const at = args.indexOf("--port");
  const first = at < 0 ? 8080 : Number(args[at + 1]);
  const folder = args[0];
  if (!folder || !Number.isInteger(first) || first < 0 || first > 65535) {
    console.error("usage: node web/serve.mjs FOLDER [--port N], N from 0 to 65535");
    return 2;
  }
  for (let port = first; port <= Math.min(first + 100, 65535); ++port) {
    try {
      const server = await serve(folder, port);
      console.log(`\n  substep runs at http://localhost:${server.address().port}/\n`);
      console.log("  Open the address in a browser. Ctrl-C ends the server.");
      const end = () => process.exit(0);
      process.on("SIGINT", end).on("SIGTERM", end);
      return undefined;
    } catch (error) {
      if (error.code === "ENOENT") {
        console.error(`There is no folder ${folder}.`);
        return 2;
      }
      if (error.code !== "EADDRINUSE") {
        console.error(`Port ${port} cannot be used: ${error.message}. Try --port with another.`);
        return 1;
      }
      if (port === first) console.log(`Port ${port} is taken; looking for a free one.`);
    }
  }
  return 1;
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  process.exitCode = await main(process.argv.slice(2));
}
