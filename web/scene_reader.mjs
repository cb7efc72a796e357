// Scenes that come as text are read in slices, so that the page answers meanwhile.

const answering = () => new Promise((next) => { setTimeout(next); });

/**
 * @returns a function that reads a text, then calls `use`, which opens what was read, starts its run
 *   and promises what `use` gave. Texts wait for those before them.
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
    last = read.catch(() => {}); // the caller's promise reports it
    return read;
  };
}
