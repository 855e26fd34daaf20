// The texts that a visitor made of the examples, from a pass's formula to its text. They survive a reload of the tab.
const key = "rainref judge: edits";

export class Edits {
  #texts = new Map();

  constructor() {
    try {
      this.#texts = new Map(JSON.parse(sessionStorage.getItem(key) ?? "[]"));
    } catch {}  // no storage, or what another version wrote: nothing was edited
  }
  get(formula) { return this.#texts.get(formula); }
  set(formula, text) {
    if (text === undefined) this.#texts.delete(formula);
    else this.#texts.set(formula, text);
    try {
      sessionStorage.setItem(key, JSON.stringify([...this.#texts]));
    } catch {}  // no storage, or a full one: the address still holds what is shown
  }
  /// Those of some passes.
  of(passes) {
    return new Map(passes.filter(({formula}) => this.#texts.has(formula)).map(({formula}) => [formula, this.#texts.get(formula)]));
  }
}
