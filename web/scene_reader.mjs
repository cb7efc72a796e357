// Scenes that come as text are read in slices, so that the page answers meanwhile.

/**
 * @returns a function that reads a text, then calls `use`, which opens what was read, and promises
 *   what that gives. Texts wait for those before them.
 */
export function makeSceneReader(wasm) {
  let last = Promise.resolve();
  return (text, use) => {
    const read = last.then(async () => {
      wasm.read(text);
      while (wasm.readSome()) await new Promise((next) => { setTimeout(next); });
      return use();
    });
    last = read.catch(() => {}); // the caller's promise reports it
    return read;
  };
}
