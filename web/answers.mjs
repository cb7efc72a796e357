// Safe answers of the API: no call throws, whatever happens when its argument is read. Getters,
// proxies and toString may throw as well.

export const largest = 32 << 20; // of a text: more than a scene file may have [letters]

export const right = () => ({ ok: true, problems: [] });
export const wrong = (pointer, message) => ({ ok: false, problems: [{ pointer, message }] });
export const tooLong = (pointer) => wrong(pointer, `has more than ${largest} characters`);

/** Any value as a short text. */
export function show(value) {
  const spells = typeof value === "number" ? [String] : [JSON.stringify, String]; // NaN, Infinity
  for (const spell of spells) {
    try {
      const text = spell(value);
      if (typeof text === "string") return text.length > 80 ? `${text.slice(0, 80)}...` : text;
    } catch { /* try the other way */ }
  }
  return "the given value";
}

/** The message for an invalid value. */
export const mustBe = (allowed, value) => `must be ${allowed}, not ${show(value)}`;

/** The message of a thrown value of any type. */
export function messageOf(error) {
  try {
    if (error instanceof Error && typeof error.message === "string") return error.message;
  } catch { /* shown as a value */ }
  return `reading it failed with ${show(error)}`;
}

export const isObject = (value) =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/** Whether the value is a text without NUL, which would truncate it in transfer. */
export const isText = (value) => typeof value === "string" && !value.includes("\0");

/** An option by name; options may be undefined. Reads it once. */
export function optionOf(options, name, otherwise) {
  if (options === undefined || options === null) return otherwise;
  if (!isObject(options)) throw new Error(mustBe(`an object with ${name}`, options));
  return options[name] ?? otherwise;
}

/**
 * Wrappers that make calls safe.
 * @param trouble returns the reason why calls can no longer be answered, or ""; checked again after
 *   the call, since reading an argument may end the laboratory
 * @returns {answering, promising, telling}: each wraps a call so that it does not throw
 */
export function makeGuards(trouble) {
  const check = () => {
    if (trouble()) throw new Error(trouble());
  };
  /** The call's result, or {ok: false, problems}. */
  const answering = (call) => (...args) => {
    try {
      check();
      const answer = call(...args);
      check();
      return answer;
    } catch (error) {
      return wrong("", messageOf(error));
    }
  };
  /** A promise of the call's result; rejects with an Error. */
  const promising = (call) => async (...args) => {
    try {
      check();
      return await call(...args);
    } catch (error) {
      throw new Error(messageOf(error));
    }
  };
  /** A promise of the call's result, or of {ok: false, problems}. */
  const telling = (call) => async (...args) => {
    try {
      check();
      const answer = await call(...args);
      check();
      return answer;
    } catch (error) {
      return wrong("", messageOf(error));
    }
  };
  return { answering, promising, telling };
}
