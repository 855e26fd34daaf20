// The published site's service worker: all that a visit may need is kept in the browser at the first one. Workbox does it; `scripts/web publish`
// puts the list of files here.
importScripts(...["core", "routing", "strategies", "range-requests", "precaching"].map(part => `workbox/workbox-${part}.prod.js`));
const {core, precaching, rangeRequests, routing, strategies} = workbox;
const kept = [];
// A new version waits until the last page of the old one is closed: a page never gets files of two versions.
core.clientsClaim();
precaching.cleanupOutdatedCaches();
precaching.addPlugins([new rangeRequests.RangeRequestsPlugin()]);  // browsers ask for parts of a film
precaching.precacheAndRoute(kept, {ignoreURLParametersMatching: [/./]});  // a page's own parameters do not change its file
// The gallery's other pictures are kept when they were seen.
routing.registerRoute(({sameOrigin, request}) => sameOrigin && request.destination === "image", new strategies.StaleWhileRevalidate({cacheName: "pictures"}));
