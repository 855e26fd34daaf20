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
/// Entries of one value, joined: "a + b, a - b: nearest".
function grouped(values, words = x => x) {
  const groups = new Map();
  for (const [name, value] of Object.entries(values)) groups.set(words(value), [...groups.get(words(value)) ?? [], name]);
  return groups.size === 1 ? [...groups.keys()][0] : [...groups].map(([text, names]) => `${text}: ${names.join(", ")}`).join("; ");
}

/// [[habit, what the device does], ...]
export function habitRows({habits: h}) {
  const errors = Object.entries(h.accuracy).map(([name, {unit, most}]) => [name, unit === "ULP" ? `${most} ULP` : `${most} absolute`]);
  return [
    ["Stores to halves", ways(named(h.half_store), x => x.rounding)],
    ["Halves beyond 65504", ways(named(h.half_store), x => `below 65536 ${x.overflow}, above ${x.beyond}`)],
    ["Subnormal halves, stored", ways(named(h.half_store), x => x.subnormals)],
    ["Subnormal halves, loaded", ways({"from images": h.load.half_subnormals, unpack2x16float: h.load.unpack2x16float_subnormals}, x => x)],
    ["Stores to 8 bits", ways(named(h.unorm8_store), codes)],
    ["Stores to sRGB", codes(h.srgb8_store.render)],
    ["Loads of 8 bits", h.load.unorm8_ulp === 0 ? "the nearest float" : `${h.load.unorm8_ulp} ULP from the nearest float`],
    ["Weights between texels", ways({"2 texels": h.filter.texels, "1024 texels": h.filter.far_texels}, weights)],
    ["Weight of a corner", weights(h.filter.product)],
    ["Weights between levels", weights(h.filter.levels)],
    ["Rounding of + - *", grouped(h.rounding, n => n === 0 ? "to nearest" : `${n} of 4096 not to nearest`)],
    ["A product and a sum", grouped(h.contraction)],
    ["Order of operations", grouped(h.order)],
    ["Subnormal floats", grouped(h.subnormals)],
    ["NaN beside 1", `min gives ${h.not_numbers["min(NaN, 1)"]} and ${h.not_numbers["min(1, NaN)"]}, max ${h.not_numbers["max(NaN, 1)"]} and ${h.not_numbers["max(1, NaN)"]}`],
    ...errors.map(([name, text]) => [`Largest error of ${name}`, text]),
  ];
}

/// The device in a few words.
export function deviceName({device: {vendor, architecture, device, description}}) {
  const words = [vendor, architecture, description || device].filter(word => word);
  return words.join(" ") || "a device whose name the browser keeps";
}
