// NumPy's .npy files, as packs hold them: version 1, C order, little endian.

/// What follows the header of `bytes`; it must be `expected` bytes long. `file` is for the message.
export function npyData(bytes, expected, file) {
  const magic = [0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59, 1, 0];
  if (bytes.length < 10 || magic.some((byte, i) => bytes[i] !== byte)) throw new Error(`${file}: expected NumPy's .npy, version 1.0`);
  const data = bytes.subarray(10 + bytes[8] + 256 * bytes[9]);
  if (data.length !== expected) throw new Error(`${file}: expected ${expected} bytes of data, found ${data.length}`);
  return data;
}

/// A file of `data`, whose elements are of the NumPy type `descr` and in the given shape.
export function npyFile(descr, shape, data) {
  const size = `(${shape.join(", ")}${shape.length === 1 ? "," : ""})`;
  let head = `{'descr': ${descr}, 'fortran_order': False, 'shape': ${size}, }`;
  head += " ".repeat(63 - (10 + head.length) % 64) + "\n";
  const bytes = new Uint8Array(10 + head.length + data.length);
  bytes.set([0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59, 1, 0, head.length & 255, head.length >> 8]);
  bytes.set(new TextEncoder().encode(head), 10);
  bytes.set(data, 10 + head.length);
  return bytes;
}

/// The NumPy type of a record of the manifest: its members, and gaps without a name.
export function recordType(record) {
  const types = {float: "<f4", int: "<i4", uint: "<u4"}, fields = [];
  let end = 0;
  const gap = to => to > end && fields.push(`('', '|V${to - end}')`);
  for (const member of record.members) {
    gap(member.offset);
    end = member.offset + 4 * member.components;
    fields.push(`('${member.name}', '${types[member.type]}'${member.components > 1 ? `, (${member.components},)` : ""})`);
  }
  gap(record.size);
  return `[${fields.join(", ")}]`;
}
