// Memory does not grow: node tests/web/memory_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { call, drawn, leave, open, openPage } from "./browser.mjs";

const slack = 64e3; // text kept until the next call, hash tables that grew a little [byte]

let session;
before(async () => { session = await open({ rate: 15 }); });
after(() => session?.close());

const used = async (page) => (await call(page, "memory")).used;

/** All panels, scenes, comparisons and sweeps once, then back to the start. */
async function round(page, scenes) {
  for (const scene of scenes) {
    await call(page, "set", { scene });
    await call(page, "step", 120);
    for (const panel of ["why", "compare", "accuracy", "plots"]) {
      await call(page, "set", { panel });
      await drawn(page);
    }
    await call(page, "set", { compare: "mode:none;mode:damping" });
    await call(page, "step", 30);
    await drawn(page);
    await call(page, "set", { compare: "off", accuracy: "run" });
    await drawn(page);
    await call(page, "set", { accuracy: "cancel" });
  }
  await call(page, "set", { scene: scenes[0] });
  await call(page, "reset");
  await call(page, "pause");
  await drawn(page);
}

test("panels, scenes, comparisons and sweeps release their memory", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  const scenes = ["swinging_box", "bridge", "heavy_stack"];
  await round(page, scenes);
  await round(page, scenes);
  const { used: begin, heap } = await call(page, "memory");
  for (let i = 0; i < 2; ++i) await round(page, scenes);
  const now = await call(page, "memory");
  assert.ok(now.used - begin < slack, `${begin} bytes, then ${now.used}`);
  assert.equal(now.heap, heap);
  await leave(page);
});

test("the memory of a long run is bounded", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  const run = async () => {
    await call(page, "set", { scene: "pendulum" });
    await call(page, "step", 40000);
    await drawn(page);
    return used(page);
  };
  const once = await run();
  const again = await run();
  assert.ok(again - once < slack, `${once} bytes, then ${again}`);
  await leave(page);
});

test("removed laboratories are freed", async () => {
  const page = await openPage(session, { path: "files.json" }); // without a laboratory
  const count = 10;
  const devtools = await page.context().newCDPSession(page);
  /** Memories of WebAssembly that are alive. */
  const alive = async () => {
    await devtools.send("HeapProfiler.collectGarbage");
    const { result } = await devtools.send("Runtime.evaluate", { expression: "WebAssembly.Memory.prototype" });
    const { objects } = await devtools.send("Runtime.queryObjects", { prototypeObjectId: result.objectId });
    const { result: list } = await devtools.send("Runtime.callFunctionOn",
      { objectId: objects.objectId, functionDeclaration: "function () { return this.length; }" });
    await devtools.send("Runtime.releaseObject", { objectId: objects.objectId });
    return list.value;
  };
  const first = await alive();
  assert.equal(first, 0);
  for (let i = 0; i < count; ++i) {
    await page.evaluate(async () => {
      const { createSubstep } = await import(new URL("substep.mjs", location.href).href);
      const place = Object.assign(document.createElement("div"), { style: "height: 200px" });
      document.body.append(place);
      const lab = await createSubstep(place, { scene: "pendulum" });
      lab.step(10);
      lab.remove();
      place.remove();
    });
  }
  await page.waitForTimeout(500);
  const left = await alive() - first;
  // A pending frame or promise may still hold the last ones.
  assert.ok(left <= 3, `${left} of ${count} are still there`);
  await leave(page);
});
