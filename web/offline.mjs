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
  try {
    // Null on the first visit: nothing to replace. It is asked before register(), which may wait as
    // long as an update of the worker itself is pending.
    container.controller?.postMessage("look");
    await container.register(new URL("service_worker.js", import.meta.url), { updateViaCache: "none" });
  } catch (error) {
    console.info("substep: no copy for use without a network:", error.message);
  }
}
