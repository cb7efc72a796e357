// Serves the laboratory from a copy in the browser. Each version is fetched as a whole into its own
// copy, so that no page mixes versions; the oldest copy is in use.
//
// The worker checks for new versions itself: a browser does so only after the page was idle for two
// seconds, or after a minute, and this page draws continuously.
const prefix = `substep ${self.registration.scope} `; // a site may hold several laboratories

/** Names of the copies, the one in use first. */
const copies = async () => (await caches.keys()).filter((name) => name.startsWith(prefix));

/** Whether a copy is complete: its files are stored together or not at all. */
async function isWhole(name) {
  return await caches.has(name) && (await (await caches.open(name)).keys()).length > 0;
}

/** Fetches the server's current version. @returns whether it differs from the one in use */
async function look() {
  const { version, files } = await (await fetch("files.json", { cache: "no-store" })).json();
  const newest = prefix + version;
  if (!await isWhole(newest)) {
    const fresh = files.map((file) => new Request(file, { cache: "no-cache" }));
    await (await caches.open(newest)).addAll(fresh);
  }
  const [inUse, ...waiting] = await copies();
  for (const name of waiting) if (name !== newest) await caches.delete(name);
  return inUse !== newest;
}

/** Replaces the version in use by the newest one, if there is one. */
async function takeOver() {
  const names = await copies();
  const newest = names.pop();
  if (names.length === 0 || !await isWhole(newest)) return;
  for (const name of names) await caches.delete(name);
}

async function answer(request) {
  const starts = request.mode === "navigate";
  if (starts && (await self.clients.matchAll({ type: "window" })).length === 0) await takeOver();
  const [inUse] = await copies();
  const found = inUse && await (await caches.open(inUse)).match(request, { ignoreSearch: true });
  return found ?? fetch(request);
}

/** Requests of a page, and their answers. */
const asked = {
  "look": async () => (await look() ? "there is a new version" : ""),
  "take over": async () => {
    await takeOver();
    return "it has taken over";
  },
};

self.addEventListener("install", (event) => event.waitUntil(look()));
self.addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));
self.addEventListener("fetch", (event) => {
  if (event.request.method === "GET") event.respondWith(answer(event.request));
});
self.addEventListener("message", (event) => {
  if (!Object.hasOwn(asked, event.data)) return;
  event.waitUntil(asked[event.data]().then(
    (reply) => { if (reply) event.source.postMessage(reply); },
    () => {})); // there may be no network
});
