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

let last = Promise.resolve();
onmessage = ({data}) => {
  if (data.module) {
    ready = start(data);
    ready.catch(() => {});  // each call says so
    return;
  }
  last = last.then(() => answer(data)).then(
    // An operation may return {result, transfer}: buffers that are transferred instead of copied.
    result => postMessage({call: data.call, result: result?.transfer ? result.result : result}, result?.transfer ?? []),
    error => postMessage({call: data.call, error: {name: error.name, message: error.message, code: error.code}}));
};
