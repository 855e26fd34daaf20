// As much of a document as the report's script needs: elements that know their attributes and children.

class Element {
  constructor(name) {
    Object.assign(this, {name, attributes: {}, children: [], listeners: {}, parent: null, style: {}, hidden: false});
    this.style.setProperty = (key, value) => { this.style[key] = value; };
  }
  get textContent() { return this.children.map(child => child.textContent ?? child).join(""); }
  set textContent(text) { this.children = [String(text)]; }
  setAttribute(key, value) { this.attributes[key] = String(value); }
  #adopted(children) {
    for (const child of children) if (child instanceof Element) child.parent = this;
    return children;
  }
  append(...children) { this.children.push(...this.#adopted(children)); }
  prepend(...children) { this.children.unshift(...this.#adopted(children)); }
  remove() { this.parent.children = this.parent.children.filter(child => child !== this); }
  addEventListener(type, listener) { (this.listeners[type] ??= []).push(listener); }
  scrollIntoView() {}
  click() { for (const listener of this.listeners.click) listener(); }
  /// Those below it that have the name or ".class", in order.
  all(what) {
    const fits = e => what.startsWith(".") ? (e.attributes.class ?? "").split(" ").includes(what.slice(1)) : e.name === what;
    return this.children.filter(child => child instanceof Element).flatMap(child => [...fits(child) ? [child] : [], ...child.all(what)]);
  }
}

export const standInDocument = {createElement: name => new Element(name), createElementNS: (_, name) => new Element(name)};
