// Registers the service worker when the page has loaded, so that the first visit is no slower; says when the site is kept. `scripts/web publish`
// puts this script into each page.
if ("serviceWorker" in navigator && !navigator.connection?.saveData) {
  if (document.readyState !== "complete") await new Promise(done => addEventListener("load", done, {once: true}));
  try {
    await navigator.serviceWorker.register("service_worker.js");
    await navigator.serviceWorker.ready;
    document.documentElement.dataset.offline = "kept";
    const state = document.getElementById("offline-state");
    if (state) state.textContent = "It is kept now: these pages work without a network.";
  } catch (error) {
    console.warn(`The pages are not kept for use without a network: ${error.message}`);  // such as in a private window; all else works
  }
}
