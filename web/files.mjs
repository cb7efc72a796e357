// Scene files come from the menu or by drag and drop; scenes, tables and pictures are downloaded;
// small values are stored in the browser between visits, and asked for on touch screens.

const largest = 8 << 20; // per scene file: the page blocks while it reads one [bytes]
const prefix = "substep."; // of stored keys

const types = { json: "application/json", csv: "text/csv", png: "image/png", svg: "image/svg+xml",
  webm: "video/webm", mp4: "video/mp4" };

/** The content of a file; throws an Error that says why it is no text. */
export async function textOf(file) {
  if (file.size > largest) {
    throw new Error(`${(file.size / 1e6).toFixed(0)} MB are too large: a scene file has ` +
      `at most ${(largest / 1e6).toFixed(0)} MB here, and 32 MB on the command line`);
  }
  const bytes = await file.arrayBuffer().catch(() => {
    throw new Error("the browser could not read it: is it a folder?");
  });
  const text = (() => {
    try {
      return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    } catch {
      return "\0";
    }
  })();
  if (text.includes("\0")) throw new Error("is not text: a scene file is JSON in UTF-8");
  return text;
}

/** @returns whether the text is in the clipboard */
export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // Without https there is no clipboard API; the old method still works.
    const field = Object.assign(document.createElement("textarea"), { value: text });
    field.style.position = "fixed";
    const active = document.activeElement;
    document.body.append(field);
    field.select();
    const done = document.execCommand("copy");
    field.remove();
    active?.focus({ preventScroll: true });
    return done;
  }
}

export function makeFiles(frame, wasm, host, readScene) {
  const tell = (text) => {
    wasm.tell(text);
    host.changed?.();
  };

  async function open(file) {
    if (!file || wasm.stopped) return;
    try {
      await readScene(await textOf(file), () => wasm.openRead(file.name));
    } catch (error) {
      wasm.trouble(`${file.name} was not loaded`, "", error.message);
    }
    frame.canvas.focus({ preventScroll: true });
    host.changed?.();
  }

  /** @param data bytes, text or a Blob */
  function save(name, data) {
    const blob = data instanceof Blob ? data
      : new Blob([data], { type: types[name.split(".").pop()] ?? "application/octet-stream" });
    const href = URL.createObjectURL(blob);
    Object.assign(document.createElement("a"), { href, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(href), 60000);
    tell(`${name} was saved to Downloads`);
  }

  host.saveFile = save;
  host.openFile = () => {
    const chooser = Object.assign(document.createElement("input"),
      { type: "file", accept: ".json,.xml,.urdf,application/json,text/xml" });
    chooser.addEventListener("change", () => open(chooser.files[0]));
    chooser.click();
  };
  host.copyText = async (text) => {
    const done = await copy(text);
    if (!done) tell("The browser does not permit copying here");
    return done;
  };
  // If storage is unavailable (private windows, blocked storage), nothing is stored.
  host.remember = (key, value) => {
    try {
      localStorage.setItem(prefix + key, value);
    } catch { /* as above */ }
  };
  host.recall = (key) => {
    try {
      return localStorage.getItem(prefix + key) ?? "";
    } catch {
      return "";
    }
  };
  host.ask = (name, value) => prompt(name, value) ?? value;

  frame.element.addEventListener("dragover", (event) => event.preventDefault(),
    { signal: frame.signal });
  frame.element.addEventListener("drop", (event) => {
    event.preventDefault();
    open(event.dataTransfer?.files[0]);
  }, { signal: frame.signal });
  return { save };
}
