// node rainref_in_node.cjs RAINREF.js ARGUMENT...: the command line as WebAssembly, with the current folder at its own place and the
// scenes of the sources where an installation has them. What it prints passes byte for byte.
const fs = require('fs'), path = require('path');

const [program, ...args] = process.argv.slice(2);
const collect = (descriptor) => {
  const bytes = [];
  return {put: (byte) => bytes.push(byte), flush: () => fs.writeSync(descriptor, Buffer.from(bytes))};
};
const output = collect(1), error = collect(2);

(async () => {
  const module = await require(path.resolve(program))({stdout: output.put, stderr: error.put, thisProgram: 'rainref'});
  const mount = (from, to) => {
    module.FS.mkdirTree(to);
    module.FS.mount(module.NODEFS, {root: from}, to);
  };
  const here = process.cwd();
  mount(here, here);
  mount(path.join(here, 'scenes'), '/share/rainref/scenes');
  module.FS.chdir(here);
  try {
    process.exitCode = module.callMain(args);
  } catch (e) {
    if (e?.name !== 'ExitStatus') throw e;
    process.exitCode = e.status;
  } finally {
    for (const stream of [output, error]) stream.flush();
  }
})();
