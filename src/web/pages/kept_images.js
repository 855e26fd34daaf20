// Images that the library makes slowly and keeps (rr_keep_images: the street around a puddle), in the browser's storage until the next visit. They are
// never required: a browser without storage makes them again. It runs in the worker, whose file system in memory holds the library's folder.

const folder = "/kept", code = "/rainref.wasm";  // where the library expects its own file, by which it knows images of another build
const mostBytes = 256e6;

const done = request => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

export class KeptImages {
  #fs;
  #store = null;   // promise of the database; null: nothing is kept
  #brought = new Map();  // name of a file to its node, which another one has that the library made in place of a damaged one
  #index = null;   // {images: {name: {bytes, used}}, scenes: {scene: [name, ...]}}
  #identity;       // of the library: each one keeps its own

  /// Before the library opens its first scene.
  constructor(library) {
    this.#fs = library.module.FS;
    if (!library.identity || typeof indexedDB === "undefined") return;
    this.#fs.writeFile(code, library.identity);
    this.#fs.mkdirTree(folder);
    library.call("rr_keep_images", folder);
    this.#identity = library.identity;
    this.#store = this.#opened();
    this.#store.catch(() => { this.#store = null; });
  }

  /// Gives the library what `scene`, any name, used when it ran before.
  async bring(scene) {
    try {
      if (!this.#store) return;
      await this.#store;
      for (const name of this.#index.scenes[`${this.#identity} ${scene}`] ?? []) {
        const bytes = await this.#in("readonly", store => store.get(name));
        if (!bytes) continue;
        this.#fs.writeFile(`${folder}/${name}`, bytes);
        this.#fs.chmod(`${folder}/${name}`, 0o600);
        this.#fs.utime(`${folder}/${name}`, 0, 0);  // the library sets the time of what it uses
        this.#brought.set(name, this.#fs.stat(`${folder}/${name}`).ino);
      }
    } catch {
      // They are made again.
    }
  }

  /// Keeps what lies in the folder for `scene`, and gives up the least recently used beyond mostBytes. The memory of the files is freed: the library
  /// holds what it uses.
  async keep(scene) {
    if (!this.#store) return;
    const files = this.#fs.readdir(folder).filter(name => name.endsWith(".images"))
      .map(name => ({name, ...this.#fs.stat(`${folder}/${name}`), bytes: this.#fs.readFile(`${folder}/${name}`)}))
      .map(({name, ino, mtime, bytes}) => ({name, isMade: ino !== this.#brought.get(name), isUsed: Number(mtime) > 0, bytes}));
    for (const {name} of files) this.#fs.unlink(`${folder}/${name}`);
    try {
      await this.#store;
      const {images, scenes} = this.#index, dropped = [];
      for (const {name, isUsed, bytes} of files) images[name] = {bytes: bytes.length, used: isUsed ? Date.now() : images[name].used};
      const own = `${this.#identity} ${scene}`;
      scenes[own] = [...new Set([...files.filter(file => file.isUsed).map(({name}) => name), ...scenes[own] ?? []])].slice(0, 8);
      let total = Object.values(images).reduce((sum, {bytes}) => sum + bytes, 0);
      for (const [name, {bytes}] of Object.entries(images).sort(([, a], [, b]) => a.used - b.used)) {
        if (total <= mostBytes) break;
        total -= bytes;
        delete images[name];
        dropped.push(name);
      }
      for (const [name, used] of Object.entries(scenes)) if (!used.some(image => images[image])) delete scenes[name];
      await this.#in("readwrite", store => {
        for (const {name, isMade, bytes} of files) if (isMade && images[name]) store.put(bytes, name);
        for (const name of dropped) store.delete(name);
        return store.put(this.#index, "index");
      });
    } catch {
      // No room: they are made again.
    }
  }

  async #opened() {
    const request = indexedDB.open("rainref.kept", 1);
    request.onupgradeneeded = () => request.result.createObjectStore("images");
    const store = this.#database = await done(request);
    this.#index = await this.#in("readonly", all => all.get("index")) ?? {images: {}, scenes: {}};
    return store;
  }
  #database = null;
  /// The result of the request that `action` makes of the store.
  async #in(mode, action) {
    return done(action(this.#database.transaction("images", mode).objectStore("images")));
  }
}
