#!/usr/bin/env node
// Serves a folder of static files on this machine only.
//   node web/serve.mjs FOLDER [--port N]
// A taken port is replaced by the next free one. Also a module: serve(folder, port).
import { createReadStream } from "node:fs";
import { stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize, resolve, sep } from "node:path";
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
  ".woff2": "font/woff2",
};

/** The file that a request asks for, or null for what is not there or outside the folder. */
async function find(folder, url) {
  try {
    let path = normalize(join(folder, decodeURIComponent(new URL(url, "http://x").pathname)));
    if (path !== folder && !path.startsWith(folder + sep)) return null;
    let info = await stat(path);
    const isFolder = info.isDirectory();
    if (isFolder) {
      path = join(path, "index.html");
      info = await stat(path);
    }
    return info.isFile() ? { path, isFolder, size: info.size } : null;
  } catch {
    return null; // no such file, or an address that cannot be read
  }
}

/** Starts a server; port 0 is any free one. Resolves to it once it listens. */
export function serve(folder, port = 0) {
  folder = resolve(folder);
  const server = createServer(async (request, response) => {
    const file = await find(folder, request.url);
    if (!file) {
      response.writeHead(404, { "Content-Type": "text/plain" }).end("not found\n");
      return;
    }
    if (file.isFolder && !new URL(request.url, "http://x").pathname.endsWith("/")) {
      // What the page names beside itself is found only below a slash.
      response.writeHead(301, { Location: `${new URL(request.url, "http://x").pathname}/` }).end();
      return;
    }
    const type = types[extname(file.path)] ?? "application/octet-stream";
    response.writeHead(200, {
      "Content-Type": type,
      "Content-Length": file.size,
      "Cache-Control": "no-cache", // a rebuilt page shows at the next reload
    });
    if (request.method === "HEAD") response.end();
    else createReadStream(file.path).on("error", () => response.destroy()).pipe(response);
  });
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
