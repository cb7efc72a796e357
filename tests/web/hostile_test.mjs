// window.substep does not throw for any argument or order of calls:
// node tests/web/hostile_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { call, leave, open, openPage } from "./browser.mjs";

let session;
before(async () => { session = await open({ rate: 15 }); });
after(() => session?.close());

/** In the page: values that misbehave when they are read. */
function hostileValues() {
  const thrower = () => { throw null; }; // no Error
  const traps = {};
  for (const name of Object.getOwnPropertyNames(Reflect)) traps[name] = thrower;
  const revoked = Proxy.revocable({}, {});
  revoked.revoke();
  const circle = {};
  circle.self = circle;
  let deep = {};
  for (let i = 0; i < 100000; ++i) deep = { deep };
  const getter = (name, error) => Object.defineProperty({}, name,
    { enumerable: true, get() { throw error; } });
  const evil = Object.defineProperty(new Error("x"), "message", { get: thrower });
  return {
    undefined: undefined, null: null, symbol: Symbol("s"), bigint: 10n ** 50n, nan: NaN,
    infinity: -Infinity, function: thrower, bare: Object.create(null), date: new Date(NaN), evil,
    toString: { toString: thrower, valueOf: thrower }, json: { toJSON: () => 1n },
    primitive: { [Symbol.toPrimitive]: thrower, toJSON: thrower },
    proxy: new Proxy({}, traps), callable: new Proxy(thrower, traps), revoked: revoked.proxy,
    circle, circular: [circle], deep, getter: getter("scene", evil), part: getter("part", null),
    seconds: getter("seconds", Symbol("s")), entry: { alpha: { valueOf: thrower } },
    symbols: { alpha: Symbol("a") }, proto: JSON.parse('{"__proto__": 1}'),
    nul: "\0{", lone: "\ud800{", brace: `{"a": "${"x".repeat(1e6)}"`, nested: "[".repeat(1e6) + "{",
    long: "x".repeat(1e7), longest: "{".repeat(4e7), longName: { ["x".repeat(1e6)]: 1 },
    longList: ["x".repeat(1e7)], bytes: new Uint8Array(1e5), element: document.body, window,
  };
}

/** In the page: the calls tried with one value: [description, () => result]. */
function attemptsWith(name, value) {
  const lab = window.substep;
  const list = [];
  const add = (what, act) => list.push([what, act]);
  for (const method of ["load", "set", "goTo", "openLink", "editText"]) {
    add(`${method}(${name})`, () => lab[method](value));
  }
  add(`step(${name})`, () => lab.step(value ?? null)); // without an argument it is one frame
  add(`load({}, ${name})`, () => lab.load({}, value));
  add(`load("bridges", ${name})`, () => lab.load("bridges", value));
  add(`set({ alpha: ${name} })`, () => lab.set({ alpha: value }));
  add(`screenshot({ part: ${name} })`, () => lab.screenshot({ part: value ?? 1 }));
  add(`record({ seconds: ${name} })`, () => lab.record({ seconds: value ?? -1 }));
  if (["part", "proxy", "revoked", "symbol", "long"].includes(name)) {
    add(`screenshot(${name})`, () => lab.screenshot(value));
  }
  if (["seconds", "proxy", "revoked", "symbol", "long"].includes(name)) {
    add(`record(${name})`, () => lab.record(value));
  }
  add(`on(${name}, function)`, () => lab.on(value, () => {}));
  if (typeof value !== "function") add(`on("frame", ${name})`, () => lab.on("frame", value));
  return list;
}

/** In the page: makes all calls. @returns {tried, threw, accepted, unclear} */
async function tryAll() {
  const found = { tried: 0, threw: [], accepted: [], unclear: [] };
  const judge = (what, answer) => {
    if (answer instanceof Error && answer.message.length > 4) return;
    if (answer.ok !== false) found.accepted.push(what);
    else if (!answer.problems.every((p) => typeof p.pointer === "string" && p.message.length > 4)) {
      found.unclear.push(what);
    }
  };
  for (const [name, value] of Object.entries(window.hostileValues())) {
    for (const [what, act] of window.attemptsWith(name, value)) {
      ++found.tried;
      try {
        const answer = act();
        judge(what, answer instanceof Promise ? await answer.catch((error) => error) : answer);
      } catch {
        found.threw.push(what);
      }
    }
    for (const method of ["report", "settings", "scenes", "widgets", "memory", "hash", "command"]) {
      if (!window.substep[method](value)) found.unclear.push(`${method}(${name})`);
    }
  }
  return found;
}

test("no call throws for any argument", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await call(page, "set", { scene: "bridge" });
  await call(page, "step", 10);
  const before = [await call(page, "hash"), await call(page, "settings")];
  for (const source of [hostileValues, attemptsWith]) {
    await page.evaluate(`window.${source.name} = ${source}; 0`);
  }
  const { tried, threw, accepted, unclear } = await page.evaluate(tryAll);
  assert.deepEqual({ threw, unclear }, { threw: [], unclear: [] });
  assert.ok(tried > 350, `${tried} calls`);
  // An object without settings changes none, and a link without a known key is not a link.
  const empty = ["bare", "date", "evil", "toString", "json", "primitive", "element"];
  assert.deepEqual(accepted.filter((what) => !empty.some((name) => what === `set(${name})`)), []);
  assert.deepEqual([await call(page, "hash"), await call(page, "settings")], before);
  page.complaints = []; // on() logs its problems
  await leave(page);
});

test("changing a result does not affect other results", async () => {
  const page = await openPage(session);
  const second = await page.evaluate(() => {
    window.substep.pause().problems.push("mine");
    return window.substep.pause();
  });
  assert.deepEqual(second, { ok: true, problems: [] });
  await leave(page);
});

/** An article with two laboratories, window.laboratories. */
async function openArticle() {
  const page = await openPage(session, { path: "example/article.html" });
  return page;
}

test("calls after remove() report that the laboratory was removed", async () => {
  const page = await openArticle();
  const { first, picture, answers } = await page.evaluate(async () => {
    const lab = window.laboratories.none;
    const picture = lab.screenshot().catch((error) => error.message);
    const first = lab.remove();
    const answers = {};
    for (const [name, method] of Object.entries(lab)) {
      const answer = method(name === "on" ? "frame" : "bridge", () => {});
      const failed = ({ message }) => ({ ok: false, problems: [{ pointer: "", message }] });
      const { ok, problems } = await Promise.resolve(answer).catch(failed);
      answers[name] = { ok, problems };
    }
    return { first, picture: await picture, answers };
  });
  assert.deepEqual(first, { ok: true, problems: [] });
  assert.match(picture, /was removed/, "a pending picture");
  assert.ok(Object.keys(answers).length >= 22, Object.keys(answers).join());
  for (const [name, { ok, problems }] of Object.entries(answers)) {
    assert.equal(ok, false, name);
    assert.match(problems[0].message, /was removed/, name);
  }
  assert.match(page.complaints.join(), /^error: substep\.on\("frame"\): [^,]*was removed[^,]*$/);
  page.complaints = [];
  await leave(page);
});

test("listeners and getters may remove the laboratory", async () => {
  const page = await openArticle();
  const answer = await page.evaluate(async () => {
    const { none, adaptive } = window.laboratories;
    const { pictures } = document.querySelector("canvas.substep-view");
    const begun = await new Promise((done) => {
      none.on("frame", () => {
        none.remove();
        done(pictures.begun);
      });
      none.play();
    });
    const loaded = adaptive.load({
      get name() {
        adaptive.remove();
        return "x";
      },
    });
    await new Promise((done) => { setTimeout(done, 500); });
    return { ...loaded, after: pictures.begun - begun };
  });
  assert.equal(answer.after, 0, "pictures begun after remove()");
  assert.equal(answer.ok, false);
  assert.match(answer.problems[0].message, /was removed/);
  await leave(page);
});
