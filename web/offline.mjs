// Stores a copy of all files in the browser for use without a network, and replaces it as a whole
// by a new version; service_worker.js does the work.

const untouched = 10000; // period after the start in which an unused page may reload [ms]
let used = false; // from the first moment on, also during loading
for (const event of ["pointerdown", "keydown"]) {
  window.addEventListener(event, () => { used = true; }, { once: true, capture: true });
}

/** Registers the service worker. Without one (plain http, private windows) the rest works. */
export async function keepOffline() {
  if (!("serviceWorker" in navigator)) return;
  const container = navigator.serviceWorker;
  container.addEventListener("message", ({ data, source }) => {
    if (used || performance.now() > untouched) return; // the new version takes over at the next start
    if (data === "there is a new version") source.postMessage("take over");
    if (data === "it has taken over") location.reload();
  });
  const worker = container.controller; // null on the first visit: nothing to replace
  try {
    await container.register(new URL("service_worker.js", import.meta.url), { updateViaCache: "none" });
    worker?.postMessage("look");
  } catch (error) {
    console.info("substep: no copy for use without a network:", error.message);
  }
}
