// A case of a pack, as a shader binds it.

/// All that a pass reads and writes, in the order of the bindings from 1 on: {name, binding, isOutput, buffer}. `buffer` is the case's
/// entry in the manifest, null for an input that the case lacks. An output that is also read is `NAME_out`.
export function boundBuffers(manifest, oneCase) {
  const pass = manifest.passes.find(p => p.name === oneCase.pass);
  const bound = [];
  const add = (name, buffer, isOutput) => bound.push({name, binding: bound.length + 1, isOutput, buffer: buffer ?? null});
  for (const name of pass.reads) add(name, oneCase.inputs.find(b => b.name === name), false);
  for (const name of pass.writes) {
    const buffer = oneCase.outputs.find(b => b.name === name);
    if (!buffer) throw new Error(`${oneCase.id}: the pack expects no output ${name}`);
    add(pass.reads.includes(name) ? name + "_out" : name, buffer, true);
  }
  return bound;
}
export const isRecords = buffer => buffer.format === "records";

/// The layout of a buffer's records.
export function recordOf(manifest, buffer) {
  const record = manifest.records.find(r => r.name === buffer.record);
  if (!record) throw new Error(`buffer ${buffer.name}: the manifest has no record ${buffer.record}`);
  return record;
}

/// Width, height and file of each mip level.
export const levelsOf = buffer => [buffer, ...(buffer.mips ?? [])];

/// Facts of the manifest that a shader may ask for by an `override` of this name: INPUT_present (1 or 0), INPUT_address_u and
/// INPUT_address_v (0 clamp, 1 repeat, 2 border, 3 mirror), INPUT_border (of the first channel).
export function factsOf(bound) {
  const addresses = {clamp: 0, repeat: 1, border: 2, mirror: 3}, facts = {};
  for (const {name, buffer, isOutput} of bound) {
    if (isOutput) continue;
    facts[name + "_present"] = buffer ? 1 : 0;
    facts[name + "_address_u"] = addresses[buffer?.address_u ?? "clamp"];
    facts[name + "_address_v"] = addresses[buffer?.address_v ?? "clamp"];
    facts[name + "_border"] = buffer?.border?.[0] ?? 0;
  }
  return facts;
}
