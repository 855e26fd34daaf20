// Cases of a pass in the form of the example ports (ports/port.js): an entry of a manifest, and NumPy files. Also the verdict on a port's
// results.
import {npyData, npyFile, recordType} from "./ports/npy.js";

const types = {3: "float", 4: "float", 5: "uint", 6: "int"};  // rr_type of members
const npyTypes = {1: "|u1", 2: "|u1", 3: "<f2", 4: "<f4", 5: "<u4", 6: "<i4"};
const recordsType = 7;

let held = null;  // {handle, entries}: rr_cases and what the page knows of each

/// Simulates and renders the next frame with the cases of `pass`: [{oneCase, records, files, expected}]. oneCase: an entry of a manifest;
/// files: from a path to its bytes; expected: [{name, type, channels, elementBytes, bytes}], the elements of the reference's outputs.
export function addCases(library, simulation, pass) {
  library.value("rr_free_cases", held?.handle ?? 0);
  held = null;
  const handle = library.out("rr_cases_of_simulation", simulation);
  held = {handle, entries: []};
  library.withTexts([pass], (names, count) => library.call("rr_next_frame_cases", simulation, names, count, handle));
  const count = library.value("rr_case_count", handle);
  for (let index = 0; index < count; ++index) held.entries.push(entryOf(library, handle, index));
  return held.entries;
}

function entryOf(library, handle, index) {
  const {id, pass, formula, inputs, outputs} = library.filled("rr_case_info", "rr_get_case", handle, index);
  const files = {}, records = [], array = (name, ...where) => library.filled("rr_array", name, handle, index, ...where);
  const keep = (file, bytes) => {
    files[file] = bytes;
    return file;
  };
  const block = array("rr_get_uniforms");
  const oneCase = {id, pass, formula, uniform_block: {file: keep("uniforms.bin", library.bytes(block.plane[0], block.texel_bytes))}, inputs: [], outputs: []};
  for (let k = 0; k < inputs; ++k) {
    const first = array("rr_get_input", k, 0), {filter, mip_filter, address_u, address_v, border} =
      library.filled("rr_sampling", "rr_get_sampling", handle, index, k);
    const entry = bufferOf(library, first, records), levels = [];
    for (let level = 0; level < first.levels; ++level) {
      const a = level === 0 ? first : array("rr_get_input", k, level);
      levels.push({width: a.width, height: a.height, file: keep(`${first.name}.${level}.npy`, fileOf(library, a, records))});
    }
    Object.assign(entry, {file: levels[0].file, min_filter: filter, mag_filter: filter, mip_filter, address_u, address_v, border});
    if (levels.length > 1) entry.mips = levels.slice(1);
    oneCase.inputs.push(entry);
  }
  const expected = [];
  for (let k = 0; k < outputs; ++k) {
    const a = array("rr_get_expected", k), judge = library.text(library.value("rr_get_judge", handle, index, k));
    oneCase.outputs.push({...bufferOf(library, a, records), file: `${a.name}.out.npy`, judge});
    expected.push({name: a.name, type: a.type, channels: a.channels, elementBytes: a.texel_bytes, bytes: dataOf(library, a)});
  }
  return {oneCase, records, files, expected};
}

function bufferOf(library, {name, type, format, width, height, layout}, records) {
  if (type !== recordsType) return {name, format, width, height};
  if (!records.some(r => r.name === format)) records.push(recordOf(library, layout));
  return {name, format: "records", record: format, count: width};
}
function recordOf(library, layout) {
  const {name, bytes, members: count} = library.filled("rr_layout_info", "rr_get_layout", layout);
  const members = Array.from({length: count}, (_, k) => {
    const {name, type, components, offset} = library.filled("rr_member", "rr_get_member", layout, k);
    return {name, type: types[type], components, offset};
  });
  return {name, size: bytes, members};
}

/// The elements of an array of a case: one plane, rows without padding.
const dataOf = (library, {plane, width, height, texel_bytes}) => library.bytes(plane[0], width * height * texel_bytes);
function fileOf(library, array, records) {
  const data = dataOf(library, array), {type, channels, width, height, format} = array;
  if (type === recordsType) return npyFile(recordType(records.find(r => r.name === format)), [width], data);
  return npyFile(`'${npyTypes[type]}'`, channels > 1 ? [height, width, channels] : [height, width], data);
}

/// `given`: for each case of addCases [{file, bytes}], the result of runCase. Returns {status, reason, outputs: [[bytes, ...], ...]}; the
/// outputs are elements only, in the order of `expected`.
export function judgeCases(library, profile, given) {
  if (!held) throw new Error("no cases to judge");
  const {handle, entries} = held, m = library.module;
  const outputs = entries.map(({oneCase, expected}, index) => oneCase.outputs.map((buffer, output) => {
    const {bytes} = given[index].find(({file}) => file === buffer.file), header = 10 + bytes[8] + 256 * bytes[9];
    const data = npyData(bytes, bytes.length - header, buffer.file), isList = buffer.format === "records";
    const rowBytes = isList ? entries[index].records.find(r => r.name === buffer.record).size : expected[output].bytes.length / buffer.height;
    const at = m._malloc(Math.max(1, data.length));
    m.HEAPU8.set(data, at);
    try {
      library.call("rr_give", handle, index, output, at, rowBytes, isList ? data.length / rowBytes : buffer.height);
    } finally {
      m._free(at);
    }
    return data.slice();
  }));
  const judgement = library.withStruct("rr_judge_options", {profile, port: "example port in WGSL", threads: 1}, options => library.out("rr_judge", handle, options));
  try {
    const {status, reason} = library.filled("rr_verdict", "rr_get_verdict", judgement), pass = library.filled("rr_pass_verdict", "rr_get_pass_verdict", judgement, 0);
    return {status, reason: reason || pass.reason, outputs, elements: pass.elements, outside: pass.outside, differing: pass.differing};
  } finally {
    library.value("rr_free_judgement", judgement);
  }
}
