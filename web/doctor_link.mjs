// The fragment of the doctor's page: a question with its model, and the badge that links to it.
import { pack, packText, unpack } from "./inline_scene.mjs";

const longest = 16_000; // of the model in it: longer addresses break in mails [letters]
const packed = new WeakMap(); // letters of models

async function lettersOf(model) {
  if (!packed.has(model)) packed.set(model, await (model.isScene ? pack : packText)(model.text));
  return packed.get(model);
}

/**
 * @param model {text, name, isScene} @param question {engine, step, held}
 * @returns the fragment without '#'; without the model if that is too large
 */
export async function writeFragment(model, { engine, step, held }) {
  const parts = [`engine=${engine}`, `step=${step}`, ...(held > 0 ? [`held=${held}`] : []),
    `name=${encodeURIComponent(model.name)}`];
  if (typeof CompressionStream === "undefined") return parts.join("&");
  const letters = await lettersOf(model);
  if (letters.length <= longest) parts.push(`${model.isScene ? "scene64" : "model64"}=${letters}`);
  return parts.join("&");
}

const decoded = (text) => {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
};

/**
 * @returns {model: {text, name} or null, asked: {engine, step, held}, problems: {pointer, message}}.
 *   The engine is not looked up.
 */
export async function readFragment(fragment) {
  const given = {};
  for (const part of fragment.replace(/^#/, "").split("&")) {
    const equals = part.indexOf("=");
    const key = equals < 0 ? part : part.slice(0, equals);
    if (key !== "" && !Object.hasOwn(given, key)) given[key] = equals < 0 ? "" : part.slice(equals + 1);
  }
  const asked = {};
  const problems = [];
  const refuse = (pointer, message) => problems.push({ pointer, message });
  for (const [key, value] of Object.entries(given)) {
    const number = Number(value);
    if (key === "engine") {
      if (/^[a-z0-9-]{1,40}$/.test(value)) asked.engine = value;
      else refuse(key, "is no name of an engine");
    } else if (key === "step") {
      if (value !== "" && number >= 1e-5 && number <= 1) asked.step = number;
      else refuse(key, "must be from 1e-05 to 1 (s)");
    } else if (key === "held") {
      if (Number.isInteger(number) && number >= 1 && number <= 1000) asked.held = number;
      else refuse(key, "must be a whole number from 1 to 1000");
    } else if (!["name", "model64", "scene64"].includes(key)) {
      refuse(decoded(key).slice(0, 80), "is unknown");
    }
  }
  const letters = given.model64 ?? given.scene64;
  if (letters === undefined) return { model: null, asked, problems };
  try {
    const text = await unpack(letters);
    if (text === "" || text.includes("\0")) throw new TypeError("it is no text");
    return { model: { text, name: decoded(given.name ?? "model").slice(0, 200) }, asked, problems };
  } catch (error) {
    refuse(given.model64 === undefined ? "scene64" : "model64", error instanceof RangeError
      ? error.message : "is not a model: was the link truncated?");
    return { model: null, asked, problems };
  }
}

/** @param svg the badge @param address to link to */
export function badgeMarkdown(svg, address, diagnosis) {
  let letters = "";
  for (const byte of new TextEncoder().encode(svg)) letters += String.fromCharCode(byte);
  const alt = `${diagnosis.summary}`.replace(/[\\[\]`*_<>!&\n]/g, " ");
  return `[![${alt}](data:image/svg+xml;base64,${btoa(letters)})](${address})\n`;
}
