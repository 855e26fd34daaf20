// The C library's module for JavaScript: texts, structs that begin with their size, and errors as exceptions. Addresses have 32 bits.

/// Error of a call: `code` is an rr_result (2 arguments, 3 files of a pack or port, 4 unreadable, 5 a defect).
export class RainrefError extends Error {
  constructor(message, code) {
    super(message);
    this.name = "RainrefError";
    this.code = code;
  }
}

// Sizes and alignments of the member types in structs of rainref.h.
const kinds = {
  size: [4, (m, p) => m.getValue(p, "i32") >>> 0, (m, p, v) => m.setValue(p, v, "i32")],
  pointer: [4, (m, p) => m.getValue(p, "i32") >>> 0, (m, p, v) => m.setValue(p, v, "i32")],
  text: [4, (m, p) => textAt(m, m.getValue(p, "i32")), (m, p, v) => m.setValue(p, v === null ? 0 : m.stringToNewUTF8(v), "i32")],
  i32: [4, (m, p) => m.getValue(p, "i32"), (m, p, v) => m.setValue(p, v, "i32")],
  i64: [8, (m, p) => Number(new DataView(m.HEAPU8.buffer).getBigInt64(p, true)), (m, p, v) => new DataView(m.HEAPU8.buffer).setBigInt64(p, BigInt(v), true)],
  f32: [4, (m, p) => m.getValue(p, "float"), (m, p, v) => m.setValue(p, v, "float")],
  f64: [8, (m, p) => m.getValue(p, "double"), (m, p, v) => m.setValue(p, v, "double")],
};
const textAt = (m, pointer) => pointer === 0 ? null : m.UTF8ToString(pointer >>> 0);

/// Structs of rainref.h, without struct_bytes: [name, kind] in order; "kind*4": an array. Add others when you need them.
export const structs = {
  rr_array: [["name", "text"], ["format", "text"], ["type", "i32"], ["channels", "i32"], ["width", "i32"], ["height", "i32"], ["levels", "i32"],
             ["planes", "i32"], ["texel_bytes", "size"], ["row_bytes", "size"], ["plane", "pointer*4"], ["layout", "pointer"]],
  rr_open_options: [["file", "text"], ["set", "pointer"], ["set_count", "size"], ["threads", "i32"]],
  rr_simulation_info: [["effect", "text"], ["variant", "text"], ["frame", "i32"], ["frames", "i32"], ["buffers", "size"], ["warnings", "size"],
                       ["scene_json", "text"]],
  rr_verdict: [["status", "text"], ["reason", "text"], ["first_bad_pass", "text"], ["profile", "text"], ["passes", "size"]],
};

/// Offsets of a C compiler: [[name, kind, count, offset], ...] and the total size.
function laidOut(members) {
  let end = 4, alignment = 4;
  const places = members.map(([name, spelled]) => {
    const [kind, count = 1] = spelled.split("*"), bytes = kinds[kind][0], offset = Math.ceil(end / bytes) * bytes;
    end = offset + bytes * count;
    alignment = Math.max(alignment, bytes);
    return [name, kind, Number(count), offset];
  });
  return {places, size: Math.ceil(end / alignment) * alignment};
}

export class CLibrary {
  /// `module`: the result of createRainref().
  constructor(module) {
    this.module = module;
  }

  /// The text at an address; null for NULL.
  text(pointer) {
    return textAt(this.module, pointer);
  }

  /// Calls rr_NAME. A text is passed as an address that is valid during the call; null is NULL. If a function that returns rr_result fails,
  /// throws RainrefError. Use `value` for functions that return something else.
  call(name, ...args) {
    const result = this.value(name, ...args);
    if (result !== 0) throw new RainrefError(this.text(this.module._rr_error()), result);
  }

  /// The same, but returns the function's result: a number or an address.
  value(name, ...args) {
    const m = this.module, made = [];
    try {
      return m["_" + name](...args.map(arg => {
        if (typeof arg !== "string") return arg ?? 0;
        made.push(m.stringToNewUTF8(arg));
        return made[made.length - 1];
      }));
    } finally {
      for (const pointer of made) m._free(pointer);
    }
  }

  /// Returns what a function writes through its last argument: a handle, or the address of a text.
  out(name, ...args) {
    const m = this.module, to = m._malloc(4);
    try {
      m.setValue(to, 0, "i32");
      this.call(name, ...args, to);
      return m.getValue(to, "i32") >>> 0;
    } finally {
      m._free(to);
    }
  }

  /// Runs body(address) with a struct of that name; members not in `values` are 0. Frees its memory afterwards.
  withStruct(name, values, body) {
    const m = this.module, {places, size} = laidOut(structs[name]), at = m._malloc(size), owned = [];
    m.HEAPU8.fill(0, at, at + size);
    m.setValue(at, size, "i32");
    for (const [member, kind, , offset] of places) {
      if (values[member] === undefined || values[member] === null) continue;
      kinds[kind][2](m, at + offset, values[member]);
      if (kind === "text") owned.push(m.getValue(at + offset, "i32") >>> 0);
    }
    try {
      return body(at);
    } finally {
      for (const pointer of [...owned, at]) m._free(pointer);
    }
  }

  /// Returns the struct of that name that a function fills through its last argument, as an object.
  filled(name, functionName, ...args) {
    return this.withStruct(name, {}, at => {
      this.call(functionName, ...args, at);
      const values = {};
      for (const [member, kind, count, offset] of laidOut(structs[name]).places) {
        const [bytes, get] = kinds[kind], all = Array.from({length: count}, (_, k) => get(this.module, at + offset + k * bytes));
        values[member] = count === 1 ? all[0] : all;
      }
      return values;
    });
  }

  /// Runs body(address, count) with an array of texts, as a `const char* const*`.
  withTexts(texts, body) {
    const m = this.module, at = m._malloc(4 * Math.max(1, texts.length)), made = texts.map(text => m.stringToNewUTF8(text));
    made.forEach((pointer, k) => m.setValue(at + 4 * k, pointer, "i32"));
    try {
      return body(at, texts.length);
    } finally {
      for (const pointer of [...made, at]) m._free(pointer);
    }
  }

  /// A copy of the bytes at an address.
  bytes(pointer, count) {
    return this.module.HEAPU8.slice(pointer, pointer + count);
  }
}
