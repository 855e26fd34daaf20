// The worker of engine.js: instantiates the library, imports the page's operations, and answers one call after the other. It is a classic
// worker, because Emscripten writes a classic script for the library.
let ready = null;
async function start({module, identity, glue, operations}) {
  importScripts(glue);
  const [{CLibrary}, script] = await Promise.all([import("./c_library.js"), import(operations)]);
  const instance = await createRainref({
    instantiateWasm: (imports, given) => {
      WebAssembly.instantiate(module, imports).then(made => given(made, module));
      return {};
    },
  });
  return {library: Object.assign(new CLibrary(instance), {identity}), script};
}

/// The library says what is wrong by RainrefError. What else comes out of it is a defect: a trap, an exception that nobody caught, no memory.
const isDefect = error => error instanceof WebAssembly.RuntimeError || error instanceof WebAssembly.Exception || error instanceof RangeError ||
  /call stack|recursion/.test(error.message);
function said(error) {
  // Errors of Emscripten's file system have a number alone.
  const words = error.message || `${error.name ?? "error"} ${error.errno ?? error.code ?? ""}`.trim();
  if (!isDefect(error)) return {name: error.name, message: words, code: error.code};
  return {name: "Defect", message: `rainref failed inside (a defect, please report it): ${words}. The next try begins anew.`, code: 5};
}

async function answer({call, operation, args}) {
  const {library, script} = await ready;
  if (typeof script[operation] !== "function") throw new Error(`no operation ${operation}`);
  return script[operation](library, args, (...progress) => postMessage({call, progress}));
}

let last = Promise.resolve();
onmessage = ({data}) => {
  if (data.module) {
    ready = start(data);
    ready.catch(error => postMessage({failed: said(error).message}));
    return;
  }
  last = last.then(() => answer(data)).then(
    // An operation may return {result, transfer}: buffers that are transferred instead of copied.
    result => postMessage({call: data.call, result: result?.transfer ? result.result : result}, result?.transfer ?? []),
    error => postMessage({call: data.call, error: said(error)}));
};
