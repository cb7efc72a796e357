// The server of ./dev run: node tests/web/serve_test.mjs
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdir, mkdtemp, rm, symlink, writeFile } from "node:fs/promises";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { serve } from "../../web/serve.mjs";

let base; // contains the served folder and files beside it that must not be served
let server;
before(async () => {
  base = await mkdtemp(join(tmpdir(), "substep-serve-"));
  const folder = join(base, "page");
  await mkdir(join(folder, "below"), { recursive: true });
  await mkdir(join(base, "page-beside"));
  await writeFile(join(folder, "index.html"), "<p>home");
  await writeFile(join(folder, "below/index.html"), "<p>below");
  await writeFile(join(folder, "engine.wasm"), "\0asm");
  await writeFile(join(base, "secret.txt"), "secret");
  await writeFile(join(base, "page-beside/index.html"), "secret");
  await symlink(join(base, "secret.txt"), join(folder, "file_out.txt"));
  await symlink(base, join(folder, "folder_out"));
  await symlink("../page-beside", join(folder, "beside_out"));
  await symlink(join(base, "secret.txt"), join(folder, "below/index.txt"));
  await symlink("nowhere", join(folder, "dangling"));
  await symlink("itself", join(folder, "itself"));
  await symlink("below/index.html", join(folder, "file_in.html"));
  await symlink("below", join(folder, "folder_in"));
  server = await serve(folder, 0);
});
after(async () => {
  server?.close();
  server?.closeAllConnections();
  await rm(base, { recursive: true });
});

/** The response to a path that is sent unchanged: fetch would normalise it. */
function ask(path, method = "GET", port = server.address().port) {
  return new Promise((done, fail) => {
    request({ host: "127.0.0.1", port, path, method }, (answer) => {
      let body = "";
      answer.setEncoding("utf8").on("data", (piece) => { body += piece; });
      answer.on("end", () => done({ status: answer.statusCode, headers: answer.headers, body }));
    }).on("error", fail).end();
  });
}

test("serves files, a folder's page and links within the folder", async () => {
  for (const [path, body] of [["/", "<p>home"], ["/below/", "<p>below"], ["/engine.wasm", "\0asm"],
    ["/file_in.html", "<p>below"], ["/folder_in/index.html", "<p>below"], ["/?a=1", "<p>home"]]) {
    const answer = await ask(path);
    assert.deepEqual([answer.status, answer.body], [200, body], path);
  }
  assert.equal((await ask("/engine.wasm")).headers["content-type"], "application/wasm");
});

test("serves a folder that is itself a link", async () => {
  await symlink(join(base, "page"), join(base, "page-link"));
  const other = await serve(join(base, "page-link"), 0);
  assert.equal((await ask("/below/", "GET", other.address().port)).body, "<p>below");
  other.close();
  other.closeAllConnections();
});

test("as a command takes the next free port and prints the address", async () => {
  const taken = server.address().port;
  const command = spawn(process.execPath, [fileURLToPath(new URL("../../web/serve.mjs", import.meta.url)),
    join(base, "page"), "--port", taken]);
  const [, port] = await new Promise((done) => {
    let said = "";
    command.stdout.setEncoding("utf8").on("data", (text) => {
      said += text;
      const address = /http:\/\/localhost:(\d+)\//.exec(said);
      if (address) done(address);
    });
  });
  assert.notEqual(Number(port), taken);
  assert.equal((await ask("/below/", "GET", port)).body, "<p>below");
  command.kill();
  assert.deepEqual(await once(command, "exit"), [0, null]);
});

test("does not follow links out of the folder", async () => {
  for (const path of ["/file_out.txt", "/folder_out/secret.txt", "/beside_out/", "/beside_out",
    "/beside_out/index.html", "/below/index.txt", "/folder_in/index.txt", "/dangling", "/itself",
    "/folder_out/page/index.html/../../secret.txt"]) {
    const answer = await ask(path);
    assert.equal(answer.status, 404, path);
    assert.ok(!answer.body.includes("secret"), path);
  }
});

test("no form of a path leaves the folder", async () => {
  for (const path of ["/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/below/../../secret.txt",
    "/..%2fpage-beside/index.html", "/%00", "/%", "//..//secret.txt", "/below\\..\\..\\secret.txt"]) {
    const answer = await ask(path);
    assert.equal(answer.status, 404, path);
    assert.ok(!answer.body.includes("secret"), path);
  }
});

test("redirects a folder without its slash on the same host", async () => {
  for (const path of ["/below", "/.//below", "/below?x=1"]) {
    const answer = await ask(path);
    assert.deepEqual([answer.status, answer.headers.location], [301, "/below/"], path);
  }
});

test("supports only GET and HEAD", async () => {
  for (const method of ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "PROPFIND"]) {
    for (const path of ["/", "/nothing", "/below"]) {
      const answer = await ask(path, method);
      assert.equal(answer.status, 405, `${method} ${path}`);
      assert.equal(answer.headers.allow, "GET, HEAD");
      assert.ok(!answer.body.includes("<p>"));
    }
  }
  const get = await ask("/");
  const head = await ask("/", "HEAD");
  assert.deepEqual([head.status, head.body], [200, ""]);
  assert.equal(head.headers["content-length"], get.headers["content-length"]);
});

test("every response has a content security policy and forbids type sniffing", async () => {
  for (const [path, method] of [["/", "GET"], ["/engine.wasm", "HEAD"], ["/nothing", "GET"],
    ["/below", "GET"], ["/", "POST"]]) {
    const { headers } = await ask(path, method);
    assert.equal(headers["x-content-type-options"], "nosniff", path);
    const policy = headers["content-security-policy"] ?? "";
    const rules = new Map(policy.split("; ").map((rule) => [rule.split(" ")[0], rule]));
    assert.equal(rules.get("default-src"), "default-src 'none'", path);
    assert.equal(rules.get("script-src"), "script-src 'self' 'wasm-unsafe-eval'", path);
    assert.equal(rules.get("connect-src"), "connect-src 'self'", path);
    for (const name of ["base-uri", "form-action", "frame-ancestors"]) assert.ok(rules.has(name), name);
  }
});
