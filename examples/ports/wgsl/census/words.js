// A census in words, for people.

/// What was measured of several ways, said once where all are alike.
function ways(values, words) {
  const said = Object.entries(values).map(([way, value]) => [way, words(value)]), [[, first]] = said;
  return said.every(([, text]) => text === first) ? first : said.map(([way, text]) => `${way}: ${text}`).join("; ");
}
const weights = ({bits, rounding, furthest}) => bits === null ? "computed as floats" + (furthest > 0 ? `, at most ${furthest.toPrecision(2)} off` : "")
                                                              : `${bits} bits, ${rounding}`;
const waysOfStores = {render: "render targets", storage: "storage images", pack2x16float: "pack2x16float"};
const named = values => Object.fromEntries(Object.entries(values).map(([way, value]) => [waysOfStores[way] ?? way, value]));
const codes = ({furthest}) => furthest < 0.501 ? "to the nearest code" : `up to ${furthest.toPrecision(3)} codes away`;
/// Entries of one value, joined: "to nearest"; or "a + b, a - b: kept; a * b: flushed to zero".
function grouped(values, words = x => x) {
  const groups = new Map();
  for (const [name, value] of Object.entries(values)) groups.set(words(value), [...groups.get(words(value)) ?? [], name]);
  return groups.size === 1 ? [...groups.keys()][0] : [...groups].map(([text, names]) => `${names.join(", ")}: ${text}`).join("; ");
}
/// What expressions are compiled to.
function changes(order) {
  const changed = Object.entries(order).filter(([, made]) => made !== "as written");
  if (changed.length === 0) return "as written";
  return changed.map(([written, made]) => `${written} becomes ${made}`).join("; ") + (changed.length < Object.keys(order).length ? "; others as written" : "");
}

/// [[habit, what the device does], ...]
export function habitRows({habits: h}) {
  return [
    ["Stores to halves", ways(named(h.half_store), x => x.rounding)],
    ["Halves of 65520 to 65535", ways(named(h.half_store), x => x.overflow)],
    ["Halves of 65536 and more", ways(named(h.half_store), x => x.beyond)],
    ["Subnormal halves, stored", ways(named(h.half_store), x => x.subnormals)],
    ["Subnormal halves, loaded", ways({"from images": h.load.half_subnormals, unpack2x16float: h.load.unpack2x16float_subnormals}, x => x)],
    ["Stores to 8 bits", ways(named(h.unorm8_store), codes)],
    ["Stores to sRGB", codes(h.srgb8_store.render)],
    ["Loads of 8 bits", h.load.unorm8 + (h.load.unorm8_ulp > 0 ? `, up to ${h.load.unorm8_ulp} ULP from the nearest one` : "")],
    ["Weights between texels", ways({"of 2 texels": h.filter.texels, "of 1024 texels": h.filter.far_texels}, weights)],
    ["Weight of a corner of four", weights(h.filter.product)],
    ["Weights between levels", weights(h.filter.levels)],
    ["Rounding of + - *", grouped(h.rounding, n => n === 0 ? "to nearest" : `${n} of 4096 not to nearest`)],
    ["A product and a sum", grouped(h.contraction)],
    ["Order of operations", changes(h.order)],
    ["Subnormal floats", grouped(h.subnormals)],
    ["NaN", grouped(Object.fromEntries(Object.entries(h.not_numbers).filter(([name]) => name.includes("NaN"))))],
    ["Infinities and zeros", grouped(Object.fromEntries(Object.entries(h.not_numbers).filter(([name]) => !name.includes("NaN"))))],
  ];
}

/// [[function, largest error, the arguments there], ...]
export const errorRows = ({habits: h}) => Object.entries(h.accuracy).map(([name, {unit, most, at}]) => {
  const error = most === "Infinity" ? "no number" : unit === "ULP" ? `${most.toPrecision(3)} ULP` : `${most.toPrecision(2)} absolute`;
  return [name, error, at.map(x => x.toPrecision(4)).join(", ")];
});

/// The device in a few words.
export function deviceName({device: {vendor, architecture, device, description}}) {
  const words = [vendor, architecture, description || device].filter(word => word);
  return words.join(" ") || "A device whose name the browser keeps";
}
