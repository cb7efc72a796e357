// Keeps a copy of all files in the browser, so that the laboratory works without a network, and puts
// a new version in its place as a whole: service_worker.js does the work.

const untouched = 10000; // after its start an unused page may reload for so long [ms]
let used = false; // from the first moment on, also while it loads
for (const event of ["pointerdown", "keydown"]) {
  window.addEventListener(event, () => { used = true; }, { once: true, capture: true });
}

/** Registers the service worker. Where there is none (plain http, private windows) all else works. */
export async function keepOffline() {
  if (!("serviceWorker" in navigator)) return;
  const container = navigator.serviceWorker;
  container.addEventListener("message", ({ data, source }) => {
    if (used || performance.now() > untouched) return; // it takes over at the next start
    if (data === "there is a new version") source.postMessage("take over");
    if (data === "it has taken over") location.reload();
  });
  const worker = container.controller; // null at the first visit: nothing to replace
  try {
    await container.register(new URL("service_worker.js", import.meta.url), { updateViaCache: "none" });
    worker?.postMessage("look");
  } catch (error) {
    console.info("substep: no copy for use without a network:", error.message);
  }
}
