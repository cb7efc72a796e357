// Keeps the experiment in the page's address: written on changes, read when the user returns. One
// of the user's own scenes is embedded as `scene64`.
import { pack, unpack } from "./inline_scene.mjs";

// Longer addresses break in mails and messengers; beyond this the address only names the scene.
const longestScene = 16_000; // letters
const settled = 300; // delay after the last change, such as of a slider [ms]

/** The parts of a fragment, not decoded. */
const partsOf = (fragment) => fragment.replace(/^#/, "").split("&").filter((part) => part !== "");

const isScene = (part) => part.startsWith("scene=");

export function makeAddress(wasm, host, readScene, keep, signal) {
  const packed = { text: "", letters: "" }; // the last embedded scene
  let written = ""; // the last fragment written or read here
  let writtenScene = ""; // its scene, as sceneOf() has it
  let before = ""; // the last fragment of the previous scene
  let timer = 0;

  /** The experiment as a URL fragment, without '#'. */
  async function link() {
    const plain = wasm.link();
    const text = wasm.ownScene();
    if (text === "" || typeof CompressionStream === "undefined") return plain;
    if (packed.text !== text) Object.assign(packed, { text, letters: await pack(text) });
    if (packed.letters.length > longestScene) return plain;
    return partsOf(plain).map((part) => (isScene(part) ? `scene64=${packed.letters}` : part)).join("&");
  }

  /** The experiment as an address of the laboratory. */
  async function url() {
    const page = keep ? location.href.replace(/#.*/, "") : new URL("index.html", import.meta.url).href;
    return `${page}#${await link()}`;
  }

  /** Opens the experiment of a fragment. @returns {ok, problems} */
  async function open(fragment) {
    const parts = partsOf(fragment);
    const scene = parts.find((part) => part.startsWith("scene64="));
    let text = "";
    if (scene) {
      try {
        text = await unpack(scene.slice("scene64=".length));
        if (text === "") throw new TypeError("it is empty");
      } catch (error) {
        const message = error instanceof RangeError ? error.message
          : "is not a scene: was the link truncated?";
        const problem = { pointer: "scene64", message };
        wasm.trouble("The link's scene could not be read", problem.pointer, problem.message);
        host.changed?.();
        return { ok: false, problems: [problem] };
      }
    }
    const rest = parts.filter((part) => part !== scene).join("&");
    const answer = JSON.parse(text === "" ? wasm.openLink(rest)
      : await readScene(text, () => wasm.openReadLink(rest)));
    host.changed?.();
    return answer;
  }

  /** The scene of a fragment; one of the user's own by its name, because its text may be edited. */
  function sceneOf(text) {
    const part = partsOf(text).find((one) => /^scene(64)?=/.test(one));
    return part?.startsWith("scene64=") ? `scene64 ${JSON.parse(wasm.report()).scene}` : part;
  }

  async function write() {
    const here = location.hash;
    const fragment = `#${await link()}`;
    if (location.hash !== here) return; // the user went elsewhere while a scene was packed
    document.title = `${JSON.parse(wasm.report()).title} · substep`;
    if (fragment === written) return;
    // Going back returns to the previous scene, without the settings and the edits in between.
    const scene = sceneOf(fragment);
    const isNewScene = written !== "" && scene !== writtenScene;
    if (isNewScene) before = written;
    written = fragment;
    writtenScene = scene;
    history[isNewScene ? "pushState" : "replaceState"](null, "", fragment);
  }

  async function read() {
    if (written !== "") before = written;
    written = location.hash; // later versions replace it
    if (written.length > 1) await open(written);
    writtenScene = sceneOf(written);
  }

  host.linkChanged = () => {
    if (!keep) return;
    clearTimeout(timer);
    timer = setTimeout(write, settled);
  };
  const leavesOutTheScene = (text) => wasm.ownScene() !== "" && !text.includes("scene64=");

  /** Copies the address. @param more further parts of the fragment, each after an "&" */
  host.copyLink = async (more) => {
    const text = await url() + more;
    if (!(await host.copyText(text))) return;
    wasm.tell(leavesOutTheScene(text)
      ? "Link copied, but this scene is too large for it, so send its file as well" : "Link copied");
    host.changed?.();
  };

  /** Copies HTML that shows the laboratory within another page. */
  host.copyEmbed = async () => {
    const escaped = (text) => text.replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;");
    const title = escaped(JSON.parse(wasm.report()).title);
    const html = `<iframe src="${escaped(await url())}" title="substep: ${title}" width="960" ` +
      'height="600" style="border: 0" loading="lazy"></iframe>';
    if (!(await host.copyText(html))) return;
    wasm.tell(leavesOutTheScene(html)
      ? "HTML copied, but this scene is too large for it"
      : "HTML copied: paste it into a page");
    host.changed?.();
  };
  host.openArticle = () => {
    window.open(new URL("example/article.html", import.meta.url).href, "_blank", "noopener");
  };

  return {
    link,
    url,
    open,
    /** Follows the address from now on. @returns whether it held an experiment */
    async start() {
      if (!keep) return false;
      const linked = location.hash.length > 1;
      await read();
      window.addEventListener("popstate", async () => {
        if (location.hash === written) return;
        clearTimeout(timer);
        await read();
      }, { signal });
      return linked;
    },
    /** Reloads the page with the previous scene's experiment, or without any. */
    goBefore() {
      history.replaceState(null, "", `${location.pathname}${location.search}${before}`);
      location.reload();
    },
    stop() {
      keep = false;
      clearTimeout(timer);
    },
  };
}
