// Presets of the live page: weather and light over the open scene. What is chosen is what the keys say, so a link and a slider need no more.
import {element} from "./report_words.js";

/// `presets` in scenes/index.json: [{name, kind, sentence, keys: {effect: [[key, its text in TOML], ...]}, files?}]. `kind`: "weather" or
/// "light"; `files`: what the keys name, if the page must bring it.
export class Presets {
  all = [];

  of(kind, effect) { return this.all.filter(preset => preset.kind === kind && preset.keys[effect]); }

  /// The preset of a kind whose keys all have its values; undefined if there is none. If there are several, the one with the most keys.
  chosen(kind, {effect, sets}) {
    const fitting = this.of(kind, effect).filter(({keys}) => keys[effect].every(([key, toml]) => sets.get(key) === toml));
    return fitting.sort((a, b) => b.keys[effect].length - a.keys[effect].length)[0];
  }
  /// The keys set, with this preset in place of others of its kind; "": with none.
  replaced(kind, name, {effect, sets}) {
    const next = new Map(sets);
    for (const {keys} of this.of(kind, effect)) for (const [key] of keys[effect]) next.delete(key);
    for (const [key, toml] of this.of(kind, effect).find(preset => preset.name === name)?.keys[effect] ?? []) next.set(key, toml);
    return next;
  }
  /// The keys of a scene of `effect` under the presets that `from` has.
  carried(from, effect) {
    return ["weather", "light"].reduce((sets, kind) => this.replaced(kind, this.chosen(kind, from)?.name ?? "", {effect, sets}), new Map());
  }

  /// The files that presets brought and these keys name.
  filesIn(sets) {
    const texts = [...sets.values()].join();
    return new Set(this.all.flatMap(({files = []}) => files.filter(file => texts.includes(`"${file}"`))));
  }

  /// Offers those of a kind; presets describe the variant "corrected" alone.
  show(select, kind, open, variant) {
    const offered = variant === "corrected" ? this.of(kind, open.effect) : [];
    select.replaceChildren(element("option", {value: ""}, "scene's own"),
      ...offered.map(({name, sentence}) => element("option", {value: name, title: sentence}, name.replaceAll("_", " "))));
    select.value = variant === "corrected" ? this.chosen(kind, open)?.name ?? "" : "";
    select.disabled = offered.length === 0;
  }
}
