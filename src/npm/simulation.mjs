// A scene that runs: frames, their hashes, buffers and the picture.
const typeArrays = {1: Uint8Array, 2: Uint8Array, 3: Uint16Array, 4: Float32Array, 5: Uint32Array, 6: Int32Array, 7: Uint8Array};
let opened = 0;

export class Simulation {
  #library;
  #handle;

  /// Rainref.open() makes it.
  constructor(library, toml, set, files, name) {
    const {FS} = library.module, folder = `/scenes/${opened++}`, file = `${folder}/${name}`;
    const put = (path, bytes) => {
      FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
      if (bytes) FS.writeFile(path, bytes);
    };
    put(file);
    for (const [path, bytes] of files) put(`${folder}/${path}`, bytes);
    this.#library = library;
    this.#handle = library.withTexts(set, (texts, set_count) =>
      library.withStruct("rr_open_options", {file, set: texts, set_count, threads: 1}, options => library.out("rr_open", toml, options)));
  }
  /// Frees its memory; no other call may follow.
  close() {
    this.#library.value("rr_close", this.#handle);
    this.#handle = 0;
  }

  /// {effect, variant, frame, frames, scene, warnings}; frame: frames simulated so far; scene: every key with its value.
  get info() {
    const {effect, variant, frame, frames, scene_json, warnings} = this.#library.filled("rr_simulation_info", "rr_get_info", this.#handle);
    const sentence = (_, k) => this.#library.text(this.#library.value("rr_warning", this.#handle, k));
    return {effect, variant, frame, frames, scene: JSON.parse(scene_json), warnings: Array.from({length: warnings}, sentence)};
  }
  /// Simulates and renders the next frame.
  nextFrame() { this.#library.call("rr_next_frame", this.#handle); }
  /// The same; returns the lines of `rainref hash`: "frame pass buffer hash".
  nextFrameHashes() { return this.#library.text(this.#library.out("rr_next_frame_hashes", this.#handle)).trimEnd().split("\n"); }
  /// Sets a key to another value, written as in TOML, from the next frame on.
  set(key, value) { this.#library.call("rr_set", this.#handle, key, value); }

  get buffers() {
    const names = [];
    for (let k = 0, name; (name = this.#library.text(this.#library.value("rr_buffer_name", this.#handle, k))) !== null; ++k) names.push(name);
    return names;
  }
  /// A copy of a buffer: {name, format, channels, width, height, planes}. A plane is a typed array, rows without padding; halves are their
  /// codes (Uint16Array), and records are bytes. Row 0 is v = 0.
  buffer(name) { return this.#copied(this.#library.filled("rr_array", "rr_get_buffer", this.#handle, name)); }
  /// The last picture: {width, height, data}, RGBA of 8 bits, top row first, as ImageData takes it.
  picture() {
    const {width, height, planes: [bottomUp]} = this.#copied(this.#library.filled("rr_array", "rr_get_picture", this.#handle));
    const data = new Uint8ClampedArray(bottomUp.length), row = 4 * width;
    for (let y = 0; y < height; ++y) data.set(bottomUp.subarray((height - 1 - y) * row, (height - y) * row), y * row);
    return {width, height, data};
  }

  #copied({name, format, type, channels, width, height, planes, texel_bytes, row_bytes, plane}) {
    const one = from => {
      const bytes = new Uint8Array(width * texel_bytes * height);
      for (let y = 0; y < height; ++y) bytes.set(this.#library.bytes(from + y * row_bytes, width * texel_bytes), y * width * texel_bytes);
      return new typeArrays[type](bytes.buffer);
    };
    return {name, format, channels, width, height, planes: plane.slice(0, planes).map(one)};
  }
}
