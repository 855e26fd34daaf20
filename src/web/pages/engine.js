// The C library in its own worker, so that the page stays responsive. A page gives the script with its operations:
//   const engine = new Engine("judge_operations.js");
//   const verdict = await engine.run("judgeFolder", {profile: "webgpu"}, {onProgress: (done, of) => ..., transfer: [...]});
// That script exports functions: run("judgeFolder", args) calls judgeFolder(library, args, progress), where library is a CLibrary
// (c_library.js) and progress(...values) calls onProgress. They keep what they need between calls in variables of their module.
// Several engines share one compiled module.

import {Cancelled} from "./cancelled.js";
import {publishedName} from "./names.js";

const compiled = new Map();
/// {module, identity}: the WebAssembly module of that name, downloaded and compiled once for the page, and the hash of its bytes; null where the
/// browser computes none. rainref_module is the library; rainref_simulator is its simulating part, which is smaller.
export function loadLibrary(name = "rainref_module") {
  if (compiled.has(name)) return compiled.get(name);
  const loaded = (async () => {
    const url = new URL(publishedName(`${name}.wasm`), import.meta.url), answer = await fetch(url);
    if (!answer.ok) throw new Error(`${url.pathname}: ${answer.status} ${answer.statusText}`);
    const bytes = answer.clone().arrayBuffer();
    // Works also if the server does not know the MIME type.
    const compiling = answer.headers.get("content-type") === "application/wasm" ? WebAssembly.compileStreaming(answer) : bytes.then(WebAssembly.compile);
    const [module, hash] = await Promise.all([compiling, bytes.then(all => globalThis.crypto?.subtle?.digest("SHA-256", all) ?? null)]);
    return {module, identity: hash && Array.from(new Uint8Array(hash), byte => byte.toString(16).padStart(2, "0")).join("")};
  })();
  compiled.set(name, loaded);
  loaded.catch(() => compiled.delete(name));  // the next call tries again
  return loaded;
}

export class Engine {
  #operations;
  #library;
  #worker = null;
  #waiting = new Map();
  #next = 0;
  #ended = 0;  // how often the worker was

  /// `operations`: a script in this folder; `library`: as for loadLibrary.
  constructor(operations, library = "rainref_module") {
    this.#operations = operations;
    this.#library = library;
  }
  get library() { return this.#library; }
  /// How often the worker ended, and with it all that it held.
  get ended() { return this.#ended; }

  /// Loads the library; the first run does so too.
  async start() {
    const {module, identity} = await loadLibrary(this.#library);
    if (this.#worker) return;
    const worker = this.#worker = new Worker(new URL("engine_worker.js", import.meta.url));
    worker.onmessage = ({data}) => {
      if (data.failed) return this.#end(new Error(data.failed));  // the next run starts another worker
      const call = this.#waiting.get(data.call);
      if (!call) return;
      if (data.progress) return call.onProgress?.(...data.progress);
      this.#waiting.delete(data.call);
      if (!data.error) return call.resolve(data.result);
      const error = Object.assign(new Error(data.error.message), data.error);
      // What a defect left in the library's memory is not to be trusted.
      if (error.name === "Defect") this.#end(error);
      call.reject(error);
    };
    worker.onerror = event => this.#end(new Error(event.message || "the worker could not be started"));
    worker.postMessage({module, identity, glue: publishedName(`${this.#library}.js`), operations: new URL(this.#operations, import.meta.url).href});
  }

  /// Calls an operation; calls run one after the other. Rejects with the operation's error (with `code` if the library gave one), or
  /// Cancelled.
  async run(operation, args = {}, {onProgress, transfer = []} = {}) {
    const ended = this.#ended;
    await this.start();
    if (ended !== this.#ended) throw new Cancelled();  // while the library was loading
    const call = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(call, {resolve, reject, onProgress});
      this.#worker.postMessage({call, operation, args}, transfer);
    });
  }

  /// Ends the worker and frees its memory; the next run starts a new one.
  cancel() {
    this.#end(new Cancelled());
  }

  #end(error) {
    ++this.#ended;
    this.#worker?.terminate();
    this.#worker = null;
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const {reject} of waiting) reject(error);
  }
}
