// The options of createSubstep, without a browser: node tests/web/options_test.mjs
import assert from "node:assert/strict";
import { test } from "node:test";
import { problemsOf, readOptions } from "../../web/options.mjs";

const usual = { play: true, address: false, wholePage: false };

test("without options, or with undefined ones, the defaults apply", () => {
  for (const none of [undefined, null, {}, { play: undefined, scene: undefined }]) {
    assert.deepEqual(readOptions(none), usual);
  }
});

test("valid options are kept", () => {
  const scene = { name: "own" };
  const all = { scene, settings: { mode: "none" }, link: "#n=3", play: false, address: true,
    wholePage: true };
  assert.deepEqual(readOptions(all), all);
  assert.deepEqual(readOptions({ scene: "bridge" }), { ...usual, scene: "bridge" });
  assert.deepEqual(readOptions(Object.create(null)), usual);
});

test("an invalid option is named, with what is allowed", () => {
  const wrong = [
    [3, /^createSubstep: the options must be an object, not 3$/],
    ["bridge", /the options must be an object, not "bridge"/],
    [["bridge"], /the options must be an object, not \["bridge"\]/],
    [{ sceen: "bridge" }, /no option is called "sceen": they are scene, settings, link, play, address, wholePage$/],
    [{ constructor: 1 }, /no option is called "constructor"/],
    [{ scene: 7 }, /scene must be the name of a scene, JSON text or an object, not 7/],
    [{ scene: null }, /scene must be .*, not null/],
    [{ scene: "a\0b" }, /scene must be/],
    [{ settings: "mode=none" }, /settings must be an object of settings, not "mode=none"/],
    [{ settings: [] }, /settings must be an object of settings, not \[\]/],
    [{ link: 3 }, /link must be a string without NUL, not 3/],
    [{ play: "no" }, /play must be true or false, not "no"/],
    [{ address: 1 }, /address must be true or false, not 1/],
    [{ wholePage: null }, /wholePage must be true or false, not null/],
    [{ get play() { throw new Error("on purpose"); } }, /play: on purpose/],
    [new Proxy({}, { ownKeys() { throw new Error("closed"); } }), /the options: closed/],
  ];
  for (const [options, message] of wrong) assert.throws(() => readOptions(options), { name: "Error", message });
});

test("all problems are in one message", () => {
  assert.throws(() => readOptions({ warp: 9, play: 0, link: {} }), (error) =>
    ["warp", "play must be", "link must be"].every((part) => error.message.includes(part)));
});

test("every option is read once", () => {
  let count = 0;
  const options = { get scene() { return count++ === 0 ? "bridge" : 7; } };
  assert.equal(readOptions(options).scene, "bridge");
  assert.equal(count, 1);
});

test("problems of a scene, settings or a link name the option", () => {
  const problems = (pointer) => ({ problems: [{ pointer, message: "must be so" }] });
  assert.deepEqual(problemsOf("scene", problems("scene")), ["scene: must be so"]);
  assert.deepEqual(problemsOf("scene", problems("")), ["scene: must be so"]);
  assert.deepEqual(problemsOf("scene", problems("/bodies/0/mass")), ["scene/bodies/0/mass: must be so"]);
  assert.deepEqual(problemsOf("settings", problems("alpha")), ["settings.alpha: must be so"]);
});
