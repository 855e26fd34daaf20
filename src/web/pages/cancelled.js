// Why a call to an engine, or a wait, ended early.

/// Error of calls that were in progress when cancel() was called.
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
    this.name = "Cancelled";
  }
}

/// The promise's result, or Cancelled as soon as the signal aborts; the promise itself goes on.
export function until(signal, promise) {
  return new Promise((done, fail) => {
    const stop = () => fail(new Cancelled());
    if (signal.aborted) stop();
    signal.addEventListener("abort", stop, {once: true});
    promise.then(done, fail).finally(() => signal.removeEventListener("abort", stop));
  });
}
