// The worker of engine.js: instantiates the library, imports the page's operations, and answers one call after the other. It is a classic
// worker, because Emscripten writes a classic script for the library.
let ready = null;
async function start({module, glue, operations}) {
  importScripts(glue);
  const [{CLibrary}, script] = await Promise.all([import("./c_library.js"), import(operations)]);
  const instance = await createRainref({
    instantiateWasm: (imports, given) => {
      WebAssembly.instantiate(module, imports).then(made => given(made, module));
      return {};
    },
  });
  return {library: new CLibrary(instance), script};
}

async function answer({call, operation, args}) {
  const {library, script} = await ready;
  if (typeof script[operation] !== "function") throw new Error(`no operation ${operation}`);
  return script[operation](library, args, (...progress) => postMessage({call, progress}));
}

/// Whether the library stopped in the middle, so that its memory is in no known state.
const isTrap = error => error instanceof WebAssembly.RuntimeError || error instanceof WebAssembly.Exception || /call stack|recursion/.test(error.message);
/// Errors of Emscripten's file system have a number alone.
function messageOf(error) {
  const words = error.message || `${error.name ?? "error"} ${error.errno ?? error.code ?? ""}`.trim();
  return isTrap(error) ? `rainref failed inside (a defect): ${words}` : words;
}

let last = Promise.resolve();
onmessage = ({data}) => {
  if (data.module) {
    ready = start(data);
    ready.catch(error => postMessage({failed: messageOf(error)}));
    return;
  }
  last = last.then(() => answer(data)).then(
    // An operation may return {result, transfer}: buffers that are transferred instead of copied.
    result => postMessage({call: data.call, result: result?.transfer ? result.result : result}, result?.transfer ?? []),
    error => postMessage({call: data.call, isTrap: isTrap(error), error: {name: error.name, message: messageOf(error), code: error.code}}));
};
