// Values of scenes as TOML writes them.

/// A value of a scene's JSON, whose type `describe` gives.
export function tomlValue(value, type) {
  if (Array.isArray(value)) return `[${value.map(v => tomlValue(v, type)).join(", ")}]`;
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "boolean") return String(value);
  if (type?.startsWith("integer")) return BigInt(value).toString();
  return String(value);
}

const equal = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/// The text of a scene: what `values` ({key: value}) says otherwise than the parameters' defaults, a table for each section.
export function sceneText(values, parameters) {
  const sections = new Map([["", []]]);
  for (const {name, type, default: usual, variant_defaults} of parameters) {
    if (!(name in values)) continue;
    const named = variant_defaults?.[values.variant] ?? usual;
    if (name !== "effect" && name !== "variant" && equal(values[name], named)) continue;
    const dot = name.indexOf("."), section = dot < 0 ? "" : name.slice(0, dot);
    if (!sections.has(section)) sections.set(section, []);
    sections.get(section).push(`${name.slice(dot + 1)} = ${tomlValue(values[name], type)}`);
  }
  return [...sections].filter(([, lines]) => lines.length > 0)
      .map(([section, lines]) => (section ? `[${section}]\n` : "") + lines.join("\n") + "\n").join("\n");
}
