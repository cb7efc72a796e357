// Serves the laboratory from a copy in the browser. The build fills in the version, a hash of all
// files: a new version is fetched as a whole into a copy of its own, so that no page ever mixes two.
const version = "@VERSION@";
const files = ["@FILES@"];

const prefix = `substep ${self.registration.scope} `; // a site may hold several laboratories
const copy = prefix + version;

self.addEventListener("install", (event) => {
  const fresh = files.map((file) => new Request(file, { cache: "no-cache" }));
  event.waitUntil(caches.open(copy).then((cache) => cache.addAll(fresh)));
});

self.addEventListener("activate", (event) => {
  event.waitUntil((async () => {
    for (const name of await caches.keys()) {
      if (name.startsWith(prefix) && name !== copy) await caches.delete(name);
    }
    await self.clients.claim();
  })());
});

self.addEventListener("message", (event) => {
  if (event.data === "take over") self.skipWaiting();
});

async function answer(request) {
  const cache = await caches.open(copy);
  const found = await cache.match(request, { ignoreSearch: true });
  return found ?? fetch(request);
}

self.addEventListener("fetch", (event) => {
  if (event.request.method === "GET") event.respondWith(answer(event.request));
});
