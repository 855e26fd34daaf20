// Values of a scene's keys as TOML writes them.

/// Every key of rr_get_info's scene_json with its value's text, in order: JSON's texts of numbers, strings, flags and arrays are TOML's too, and
/// as texts no digit of theirs is lost.
export function valuesOf(sceneJson) {
  const pair = /"((?:[^"\\]|\\.)*)"\s*:\s*("(?:[^"\\]|\\.)*"|\[[^\]]*\]|[^,}\s]+)/g;
  return new Map([...sceneJson.matchAll(pair)].map(([, key, value]) => [key, value]));
}

/// A scene file with the keys whose values are not the defaults; others may not be said everywhere (sequence.first without a sequence).
/// `description`: of rr_describe.
export function tomlOf(values, description) {
  const lines = ["# Saved by rainref's live page. Keys that are not here have their defaults."], sections = new Map();
  const variant = JSON.parse(values.get("variant"));
  const isDefault = (key, value) => {
    const parameter = description.parameters.find(p => p.name === key), standard = parameter?.variant_defaults?.[variant] ?? parameter?.default ?? null;
    return standard !== null && JSON.stringify(JSON.parse(value)) === JSON.stringify(standard);
  };
  for (const [key, value] of values) {
    if (isDefault(key, value)) continue;
    const dot = key.lastIndexOf(".");
    if (dot < 0) {
      lines.push(`${key} = ${value}`);
      continue;
    }
    const section = key.slice(0, dot);
    if (!sections.has(section)) sections.set(section, []);
    sections.get(section).push(`${key.slice(dot + 1)} = ${value}`);
  }
  for (const [section, own] of sections) lines.push("", `[${section}]`, ...own);
  return lines.join("\n") + "\n";
}

/// What a person typed for a parameter of rr_describe, as TOML writes it. Texts and choices need quotes, which nobody types.
export function tomlValue(type, typed) {
  if (type === "text" || type === "choice") return JSON.stringify(typed);
  const text = typed.trim();
  if (/^(integer|real)[23]$/.test(type) && !text.startsWith("[")) return `[${text}]`;
  return text;
}
/// The other way.
export function shownValue(type, toml) {
  if (type === "text" || type === "choice") return JSON.parse(toml);
  if (/^(integer|real)[23]$/.test(type)) return toml.slice(1, -1).split(",").map(part => trimmed(part.trim())).join(", ");
  return trimmed(toml);
}
const trimmed = number => number.replace(/^(-?\d+)\.0$/, "$1");

/// A word of a command line, quoted where a shell would split or change it.
export const shellWord = word => /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", `'\\''`)}'`;
