// How the API answers, so that no call throws whatever its argument does when it is read: getters,
// proxies and toString may throw, too.

export const largest = 32 << 20; // of a text: more than a scene file may have [letters]

export const right = () => ({ ok: true, problems: [] });
export const wrong = (pointer, message) => ({ ok: false, problems: [{ pointer, message }] });
export const tooLong = (pointer) => wrong(pointer, `has more than ${largest} letters`);

/** Any value as a short text. */
export function show(value) {
  for (const spell of [JSON.stringify, String]) {
    try {
      const text = spell(value);
      if (typeof text === "string") return text.length > 80 ? `${text.slice(0, 80)}...` : text;
    } catch { /* the other way may work */ }
  }
  return "what was given";
}

/** What was thrown, which may be anything, as a text. */
export function messageOf(error) {
  try {
    if (error instanceof Error && typeof error.message === "string") return error.message;
  } catch { /* shown as a value */ }
  return `reading it failed with ${show(error)}`;
}

export const isObject = (value) =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/** A text without what would end it early on its way. */
export const isText = (value) => typeof value === "string" && !value.includes("\0");

/** An option by its name, where options may be left out. It is read once. */
export function optionOf(options, name, otherwise) {
  if (options === undefined || options === null) return otherwise;
  if (!isObject(options)) throw new Error(`${show(options)} is not an object with ${name}`);
  return options[name] ?? otherwise;
}

/**
 * Makes calls safe to call.
 * @param trouble gives why no call can be answered any more, or ""; asked again after the call,
 *   since what is read from an argument may end the laboratory
 * @returns {answering, promising, telling}: each makes a call into one that does not throw
 */
export function makeGuards(trouble) {
  const check = () => {
    if (trouble()) throw new Error(trouble());
  };
  /** The call's answer, or {ok: false, problems}. */
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
  /** A promise of what the call gives; it fails with an Error. */
  const promising = (call) => async (...args) => {
    try {
      check();
      return await call(...args);
    } catch (error) {
      throw new Error(messageOf(error));
    }
  };
  /** A promise of the call's answer, or of {ok: false, problems}. */
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
