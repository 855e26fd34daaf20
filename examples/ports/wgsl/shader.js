// What a WGSL text declares, and whether that is what a pass needs. The compiler has the last word; this says it by name.

/// A sampler of the input at binding n is bound here.
export const samplerOf = binding => binding + 16;

/// {isCompute, bindings: Map of number to {name, kind}, overrides: Set of names, group: [x, y]}; kinds: uniform, read, write, texture,
/// storage texture, sampler.
export function declarationsOf(wgsl) {
  const text = wgsl.replace(/\/\*[\s\S]*?\*\//g, " ").replace(/\/\/.*/g, "");
  const isCompute = /@compute\b/.test(text);
  if (isCompute === /@fragment\b/.test(text)) throw new Error("the shader needs one entry point, @compute or @fragment");
  if (!/\bfn\s+main\s*\(/.test(text)) throw new Error("the shader's entry point must be called main");
  const bindings = new Map();
  const declaration = /((?:@(?:group|binding)\s*\(\s*\d+\w?\s*\)\s*)+)var\s*(?:<([^>]*)>)?\s*(\w+)\s*:\s*(\w+)/g;
  for (const [, attributes, space, name, type] of text.matchAll(declaration)) {
    const group = /@group\s*\(\s*(\d+)/.exec(attributes), binding = /@binding\s*\(\s*(\d+)/.exec(attributes);
    if (group?.[1] !== "0" || !binding) throw new Error(`${name}: expected @group(0) and a @binding`);
    const kind = space === undefined ? (type === "sampler" ? "sampler" : type.startsWith("texture_storage") ? "storage texture" : "texture")
                 : space.trim() === "uniform" ? "uniform" : /write/.test(space) ? "write" : "read";
    bindings.set(Number(binding[1]), {name, kind});
  }
  const overrides = new Set([...text.matchAll(/\boverride\s+(\w+)/g)].map(match => match[1]));
  const size = /@workgroup_size\s*\(\s*(\d+)\w?\s*(?:,\s*(\d+)\w?)?/.exec(text);
  if (isCompute && !size) throw new Error("@workgroup_size: expected one or two numbers");
  return {isCompute, bindings, overrides, group: isCompute ? [Number(size[1]), Number(size[2] ?? 1)] : null};
}

/// Throws where the shader binds what the pass has not, or as something else.
export function checkBindings(declared, bound, isRecords) {
  const expected = new Map([[0, {name: "the uniform block", kinds: ["uniform"]}]]);
  for (const {name, binding, isOutput, buffer} of bound) {
    const isList = buffer && isRecords(buffer);
    if (isOutput && !isList && !declared.isCompute) continue;
    const kinds = isOutput ? [isList ? "write" : "storage texture"] : !buffer ? ["read", "texture"] : [isList ? "read" : "texture"];
    expected.set(binding, {name, kinds});
    if (!isOutput && !isList) expected.set(samplerOf(binding), {name: `the sampler of ${name}`, kinds: ["sampler"]});
    if (isOutput && isList && !declared.isCompute) throw new Error(`output ${name} is a list: the pass needs a @compute shader`);
  }
  const words = {uniform: "var<uniform>", read: "var<storage, read>", write: "var<storage, read_write>"};
  const all = [...expected].map(([number, {name}]) => `${number} ${name}`).join(", ");
  for (const [number, {name, kind}] of declared.bindings) {
    const meant = expected.get(number);
    if (!meant) throw new Error(`${name}: the pass has no binding ${number}; it has ${all}`);
    if (!meant.kinds.includes(kind))
      throw new Error(`${name}: binding ${number} is ${meant.name}: expected ${meant.kinds.map(k => words[k] ?? k).join(" or ")}, found ${words[kind] ?? kind}`);
  }
  for (const {name, binding} of bound) {
    const other = [...declared.bindings].find(([number, found]) => number !== binding && found.name === name);
    if (other) throw new Error(`${name}: its binding is ${binding}, the shader declares it at ${other[0]}`);
  }
  for (const {name, binding, isOutput} of bound)
    if (isOutput && expected.has(binding) && !declared.bindings.has(binding)) throw new Error(`output ${name}: the shader does not declare binding ${binding}`);
}

/// Compiles; throws with the lines that the compiler complains of. `files`: [{name, text}], whose texts were joined.
export async function compile(device, files) {
  const module = device.createShaderModule({code: joined(files)});
  const errors = (await module.getCompilationInfo()).messages.filter(message => message.type === "error");
  if (errors.length === 0) return module;
  const lines = joined(files).split("\n");
  throw new Error(errors.map(({lineNum, linePos, message}) => {
    const place = placeOf(files, lineNum);
    return `${place.name}:${place.line}:${linePos}: ${message}\n  ${lines[lineNum - 1] ?? ""}`;
  }).join("\n"));
}
export const joined = files => files.map(file => file.text.endsWith("\n") ? file.text : file.text + "\n").join("");
function placeOf(files, line) {
  for (const file of files) {
    const count = joined([file]).split("\n").length - 1;
    if (line <= count) return {name: file.name, line};
    line -= count;
  }
  return {name: files[files.length - 1].name, line};
}
