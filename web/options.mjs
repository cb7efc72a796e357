// The options of createSubstep: all of them are checked, and one that is unknown or has another type
// is an error that names it and what is allowed.
import { isObject, isText, messageOf, mustBe } from "./answers.mjs";

const flag = { allowed: "true or false", has: (value) => typeof value === "boolean" };
const known = {
  scene: { allowed: "the name of a scene, JSON text or an object",
    has: (value) => isText(value) || isObject(value) },
  settings: { allowed: "an object of settings", has: isObject },
  link: { allowed: "a string without NUL", has: isText },
  play: flag,
  address: flag,
  wholePage: flag,
};
const defaults = { play: true, address: false, wholePage: false };

/** The error of createSubstep for some problems. */
export const optionError = (problems) => new Error(`createSubstep: ${problems.join("; ")}`);

/**
 * Reads every option once.
 * @param options of createSubstep; undefined and null are no options, undefined is not given
 * @returns all options, with their defaults; throws an Error that lists every problem
 */
export function readOptions(options) {
  const read = { ...defaults };
  if (options === undefined || options === null) return read;
  if (!isObject(options)) throw optionError([`the options ${mustBe("an object", options)}`]);
  const problems = [];
  let names = [];
  try {
    names = Object.keys(options);
  } catch (error) {
    throw optionError([`the options: ${messageOf(error)}`]);
  }
  for (const name of names) {
    if (!Object.hasOwn(known, name)) {
      problems.push(`no option is called "${name}": they are ${Object.keys(known).join(", ")}`);
      continue;
    }
    const { allowed, has } = known[name];
    try {
      const value = options[name];
      if (value === undefined) continue;
      if (has(value)) read[name] = value;
      else problems.push(`${name} ${mustBe(allowed, value)}`);
    } catch (error) {
      problems.push(`${name}: ${messageOf(error)}`);
    }
  }
  if (problems.length > 0) throw optionError(problems);
  return read;
}

/** The problems of a call with the value of an option, as texts that name the option. */
export const problemsOf = (name, { problems }) => problems.map(({ pointer, message }) => {
  const place = pointer === "" || pointer === name ? name
    : `${name}${pointer.startsWith("/") ? "" : "."}${pointer}`;
  return `${place}: ${message}`;
});
