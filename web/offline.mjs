// Keeps a copy of all files in the browser, so that the laboratory works without a network, and puts
// a new version in its place as a whole: service_worker.js does the work.

const untouched = 5000; // so long after its start a page that nobody used may start anew [ms]

/** Waits until a new version is complete, if there is one. */
function ready(worker) {
  return new Promise((done) => {
    const check = () => {
      if (worker.state === "installed") done(true);
      if (worker.state === "redundant") done(false);
    };
    worker.addEventListener("statechange", check);
    check();
  });
}

async function replace(worker, registration, isUsed) {
  if (!(await ready(worker)) || registration.waiting !== worker) return;
  if (isUsed()) return; // it takes over at the next start
  navigator.serviceWorker.addEventListener("controllerchange", () => location.reload(), { once: true });
  worker.postMessage("take over");
}

/** Registers the service worker. Where there is none (plain http, private windows) all else works. */
export async function keepOffline() {
  if (!("serviceWorker" in navigator)) return;
  let used = false;
  for (const event of ["pointerdown", "keydown"]) {
    window.addEventListener(event, () => { used = true; }, { once: true, capture: true });
  }
  const isUsed = () => used || performance.now() > untouched;
  try {
    const hadOne = navigator.serviceWorker.controller !== null;
    const registration = await navigator.serviceWorker.register(
      new URL("service_worker.js", import.meta.url), { updateViaCache: "none" });
    if (!hadOne) return; // the first visit: nothing to replace
    // A version that came while an older one ran has waited for a start like this.
    if (registration.waiting) await replace(registration.waiting, registration, () => used);
    const next = () => {
      if (registration.installing) replace(registration.installing, registration, isUsed);
    };
    registration.addEventListener("updatefound", next);
    next(); // the browser may have found it before this page did
    registration.update().catch(() => {}); // or look later than people wait; there may be no network
  } catch (error) {
    console.info("substep: no copy for use without a network:", error.message);
  }
}
