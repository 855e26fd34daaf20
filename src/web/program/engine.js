// In place of ../pages/engine.js where `rainref view` serves the page: the same interface, over operations of the program (cli/view/session.h),
// which runs them on all threads. Paths are relative to the page, whose address holds the program's secret.
import {Cancelled} from "./cancelled.js";

const newSession = () => [...crypto.getRandomValues(new Uint8Array(16))].map(byte => byte.toString(16).padStart(2, "0")).join("");

/// The messages of an answer, one after the other: cli/view/sessions.h. The last one's bytes become a member of its result.
async function* messagesOf(answer) {
  const reader = answer.body.getReader();
  let parts = [], length = 0;
  const take = async count => {  // the next bytes
    while (length < count) {
      const {done, value} = await reader.read();
      if (done) throw new Error("the program ended before it answered");
      parts.push(value);
      length += value.length;
    }
    const all = new Uint8ClampedArray(count);
    for (let at = 0; at < count;) {
      const part = parts[0].subarray(0, count - at);
      all.set(part, at);
      at += part.length;
      if (part.length < parts[0].length) parts[0] = parts[0].subarray(part.length);
      else parts.shift();
    }
    length -= count;
    return all;
  };
  for (let isLast = false; !isLast;) {
    const sizes = new DataView((await take(8)).buffer), json = await take(sizes.getUint32(0, true)), bytes = await take(sizes.getUint32(4, true));
    const message = JSON.parse(new TextDecoder().decode(json));
    isLast = !message.progress;
    if (message.member) message.result[message.member] = bytes;
    yield message;
  }
}

export class Engine {
  #session = newSession();
  #running = new Set();  // to abort
  #ended = 0;

  constructor() {
    addEventListener("pagehide", ({persisted}) => { if (!persisted) this.#close(); });
  }
  get library() { return "program"; }
  /// How often the session was left.
  get ended() { return this.#ended; }

  async start() {}

  /// Calls an operation. `files` of its arguments are sent beside them. `signal` aborts this call alone.
  async run(operation, {files = [], ...args} = {}, {onProgress, signal} = {}) {
    if (signal?.aborted) throw new Cancelled();
    const form = new FormData(), aborting = new AbortController();
    form.append("args", JSON.stringify(args));
    for (const {path, bytes} of files) form.append("file", new Blob([bytes]), path);
    signal?.addEventListener("abort", () => aborting.abort());
    this.#running.add(aborting);
    try {
      const answer = await fetch(`run/${this.#session}/${operation}`, {method: "POST", body: form, signal: aborting.signal});
      if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}: ${await answer.text()}`);
      for await (const {progress, result, error} of messagesOf(answer)) {
        if (error) throw Object.assign(new Error(error.message), error);
        if (!progress) return result;
        onProgress?.(...progress);
      }
    } catch (error) {
      if (aborting.signal.aborted) throw new Cancelled();
      if (error instanceof TypeError) throw new Error("the program does not answer: start rainref view again");
      throw error;
    } finally {
      this.#running.delete(aborting);
    }
  }

  /// Leaves the running operations and their scene; the next run begins a new one.
  cancel() {
    ++this.#ended;
    for (const aborting of this.#running) aborting.abort();
    this.#close();
    this.#session = newSession();
  }
  #close() { navigator.sendBeacon(`run/${this.#session}/close`); }
}
