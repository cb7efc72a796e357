// Parses scene texts in slices, so that the page stays responsive.

const answering = () => new Promise((next) => { setTimeout(next); });

/**
 * @returns a function that parses a text, calls `use` to open the scene, starts its run and resolves
 *   to the result of `use`. Texts are processed in order.
 */
export function makeSceneReader(wasm) {
  let last = Promise.resolve();
  return (text, use) => {
    const read = last.then(async () => {
      await answering();
      wasm.read(text);
      do await answering(); while (wasm.readSome());
      await answering();
      const given = use();
      await answering();
      if (!wasm.stopped) wasm.startOpened();
      return given;
    });
    last = read.catch(() => {}); // reported by the caller's promise
    return read;
  };
}
