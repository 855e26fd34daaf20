// A case of a running scene as the WGSL runner takes cases of packs: a manifest of one case, and the files that it names.
import {npyFile, recordType} from "./ports/npy.js";
import {formatOf, texelBytes} from "./ports/formats.js";

const scalarTypes = {4: "float", 5: "uint", 6: "int"};  // RR_FLOAT32, RR_UINT32, RR_INT32

/// {case, records, files, expected}: `case` and `records` as a manifest spells them, `files` from a path to bytes, `expected` the data of
/// each output without a header.
export function caseOf(library, cases, index) {
  const info = library.filled("rr_case_info", "rr_get_case", cases, index), files = {}, records = new Map(), expected = {};
  const at = (name, ...args) => library.filled("rr_array", name, cases, index, ...args);
  const block = at("rr_get_uniforms");
  files["uniforms.bin"] = library.bytes(block.plane[0], block.texel_bytes);
  const inputs = [], outputs = [];
  for (let i = 0; i < info.inputs; ++i) {
    const array = at("rr_get_input", i, 0), sampling = library.filled("rr_sampling", "rr_get_sampling", cases, index, i);
    const buffer = bufferOf(library, array, records);
    const levels = array.layout ? [array] : Array.from({length: array.levels}, (_, level) => level === 0 ? array : at("rr_get_input", i, level));
    const named = levels.map((level, k) => {
      const file = `in.${array.name}.${k}.npy`;
      files[file] = fileOf(library, level, buffer, records);
      return {file, width: level.width, height: level.height};
    });
    const filter = sampling.filter === "none" ? "nearest" : sampling.filter;
    inputs.push({...buffer, ...named[0], mips: named.slice(1), min_filter: filter, mip_filter: sampling.mip_filter, address_u: sampling.address_u,
                 address_v: sampling.address_v, border: sampling.border});
  }
  for (let i = 0; i < info.outputs; ++i) {
    const array = at("rr_get_expected", i), buffer = bufferOf(library, array, records);
    expected[array.name] = dataOf(library, array);
    outputs.push({...buffer, file: `out.${array.name}.npy`, width: array.width, height: array.height});
  }
  const {id, pass, formula, frame} = info;
  return {case: {id, pass, formula, frame, uniform_block: {file: "uniforms.bin"}, inputs, outputs}, records: [...records.values()], files, expected};
}

function bufferOf(library, array, records) {
  if (!array.layout) return {name: array.name, format: array.format};
  const record = layoutOf(library, array.layout);
  records.set(record.name, record);
  return {name: array.name, format: "records", record: record.name, count: array.width};
}
function layoutOf(library, layout) {
  const {name, bytes, members} = library.filled("rr_layout_info", "rr_get_layout", layout);
  return {name, size: bytes, members: Array.from({length: members}, (_, k) => {
    const member = library.filled("rr_member", "rr_get_member", layout, k);
    return {name: member.name, type: scalarTypes[member.type], components: member.components, offset: member.offset};
  })};
}
/// The texels or records of an array of a case: one plane, rows without padding.
const dataOf = (library, array) => library.bytes(array.plane[0], array.layout ? array.width * array.texel_bytes : array.height * array.row_bytes);
function fileOf(library, array, buffer, records) {
  const data = dataOf(library, array);
  if (array.layout) return npyFile(recordType(records.get(buffer.record)), [array.width], data);
  const format = formatOf(buffer), shape = [array.height, array.width];
  if (array.row_bytes !== array.width * texelBytes(format)) throw new Error(`buffer ${buffer.name}: rows with padding`);
  return npyFile(`'${format.type}'`, format.channels > 1 ? [...shape, format.channels] : shape, data);
}
