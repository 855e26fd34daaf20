// A device in JavaScript with the four functions of examples/ports/wgsl/census/tools.js, whose habits are given:
//   half: (value, below, above, negative, isOdd) => whether the half `above` is stored, where the bits of `below` are odd; overflow: bits;
//   flushHalf; code: x => the code of x [1/255]; unorm: code => float
//   weight: share => weight; product(fx, fy) => weight; level: share => weight
//   fuse, reorder, flush: booleans; nan: what min and max give beside NaN; error: ULP that every function is off by
const words = new Uint32Array(1), floats = new Float32Array(words.buffer);
const bitsOf = x => (floats[0] = x, words[0]), fromBits = bits => (words[0] = bits, floats[0]);
const f = Math.fround;

/// All halves but NaN, by their bits: written down here by the format's definition, not by the probes' code.
const halves = Array.from({length: 0x7c00}, (_, bits) => {
  const exponent = Math.floor(bits / 1024), rest = bits % 1024;
  return exponent === 0 ? rest / 2 ** 24 : (1 + rest / 1024) * 2 ** (exponent - 15);
});
/// a b + c to the nearest float, by integers: the double sum of parts alone would be rounded twice.
function fusedExactly(a, b, c) {
  const scale = x => {
    if (x === 0) return [0n, 0];
    let exponent = 0;
    while (x !== Math.trunc(x)) [x, exponent] = [2 * x, exponent - 1];
    return [BigInt(x), exponent];
  };
  const [ma, ea] = scale(a), [mb, eb] = scale(b), [mc, ec] = scale(c), low = Math.min(ea + eb, ec);
  const sum = ((ma * mb) << BigInt(ea + eb - low)) + (mc << BigInt(ec - low)), magnitude = sum < 0n ? -sum : sum;
  const extra = magnitude.toString(2).length - 24;
  if (extra <= 0) return Number(sum) * 2 ** low;
  const half = 1n << BigInt(extra - 1), cut = magnitude >> BigInt(extra), rest = magnitude & ((1n << BigInt(extra)) - 1n);
  const rounded = cut + (rest > half || (rest === half && (cut & 1n) === 1n) ? 1n : 0n);
  return (sum < 0n ? -1 : 1) * Number(rounded) * 2 ** (low + extra);
}

const nearestEven = (value, below, above, negative, isOdd) => value - below > above - value || (value - below === above - value && isOdd);
export const truncating = () => false;

export const exactDevice = {
  half: nearestEven, overflow: 0x7c00, flushHalf: false, code: x => Math.round(x), unorm: k => f(k / 255), weight: s => s, product: (x, y) => x * y, level: s => s,
  fuse: false, reorder: false, flush: false, nan: "other", error: 0, filtersFloats: true,
};

export function emulated(habits) {
  const flushed = x => habits.flush && Math.abs(x) < 2 ** -126 ? 0 * x : x;
  const op = exact => (...args) => flushed(f(exact(...args.map(flushed))));
  const add = op((x, y) => x + y), mul = op((x, y) => x * y), div = op((x, y) => x / y);
  const madd = habits.fuse ? (x, y, z) => fusedExactly(x, y, z) : (x, y, z) => add(mul(x, y), z);
  const sloppy = exact => (...args) => {
    const y = exact(...args), nearest = f(y);
    return habits.error === 0 ? nearest : fromBits(bitsOf(nearest) + habits.error);
  };
  const choose = keep => (x, y) => Number.isNaN(x) || Number.isNaN(y) ? (habits.nan === "other" ? (Number.isNaN(x) ? y : x) : NaN) : keep(x, y);
  const min = choose(Math.min), max = choose(Math.max), clamp = (x, low, high) => min(max(x, low), high);
  const expressions = {
    "a + b": add, "a - b": (a, b) => add(a, -b), "a * b": mul, "a / b": sloppy((a, b) => a / b),
    "a * b + c": madd, "c - a * b": (a, b, c) => madd(-a, b, c), "a * a - c": (a, b, c) => madd(a, a, -c),
    "(a + b) + c": (a, b, c) => habits.reorder ? add(a, add(b, c)) : add(add(a, b), c),
    "a + (b + c)": (a, b, c) => add(a, add(b, c)),
    "(a + b) - a": (a, b) => habits.reorder ? b : add(add(a, b), -a),
    "(a * b) * c": (a, b, c) => mul(mul(a, b), c),
    "a * b + a * c": (a, b, c) => habits.reorder ? mul(a, add(b, c)) : madd(a, b, mul(a, c)),
    "a / 3.0": a => habits.reorder ? mul(a, f(1 / 3)) : div(a, 3),
    "inverseSqrt(a)": sloppy(a => 1 / Math.sqrt(a)), "sqrt(a)": sloppy(Math.sqrt), "exp(a)": sloppy(Math.exp), "exp2(a)": sloppy(a => 2 ** a),
    "log(a)": sloppy(Math.log), "log2(a)": sloppy(Math.log2), "sin(a)": sloppy(Math.sin), "cos(a)": sloppy(Math.cos),
    "atan2(a, b)": sloppy(Math.atan2), "pow(a, b)": sloppy((a, b) => a ** b),
    "min(a, b)": min, "min(b, a)": (a, b) => min(b, a), "max(a, b)": max, "max(b, a)": (a, b) => max(b, a), "clamp(a, d, b)": (a, b, c, d) => clamp(a, d, b),
    "saturate(a)": a => clamp(a, 0, 1), "select(0.0, 1.0, a == a)": a => a === a ? 1 : 0, "b / d": (a, b, c, d) => b / d, "d / d": (a, b, c, d) => d / d,
    "c - c": (a, b, c) => c - c, "c * d": (a, b, c, d) => c * d, "min(c, b)": (a, b, c) => min(c, b), "max(-c, b)": (a, b, c) => max(-c, b),
    "sqrt(-b)": (a, b) => Math.sqrt(-b), "log2(d)": (a, b, c, d) => Math.log2(d),
  };
  const halfOf = x => {
    const sign = x < 0 ? 0x8000 : 0, value = Math.abs(x);
    if (value >= 65520) return sign | habits.overflow;
    let low = 0, high = halves.length;  // the largest half that is not above
    while (high - low > 1) [low, high] = halves[(low + high) >> 1] <= value ? [(low + high) >> 1, high] : [low, (low + high) >> 1];
    const up = halves[low] !== value && low + 1 < halves.length && habits.half(value, halves[low], halves[low + 1], x < 0, low % 2 === 1);
    const bits = low + (up ? 1 : 0);
    return habits.flushHalf && bits < 0x400 ? sign : sign | bits;
  };
  const encode = x => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
  const mix = (low, high, share) => low + share * (high - low);

  return {
    filtersFloats: habits.filtersFloats,
    async evaluate(expression, rows) {
      if (expression === "pack2x16float(vec2f(a, b))") return Uint32Array.from(rows, row => halfOf(fromBits(row[0])));
      if (expression === "unpack2x16float(bitcast<u32>(a)).x") return Uint32Array.from(rows, ([bits]) => bitsOf(habits.flushHalf && bits < 0x400 ? 0 : halves[bits]));
      if (!expressions[expression]) throw new Error(`the emulated device does not know ${expression}`);
      return Uint32Array.from(rows, row => bitsOf(expressions[expression](...row.map(fromBits))));
    },
    async store(format, how, values) {
      const code = x => Math.min(255, Math.max(0, habits.code(255 * (format === "rgba8unorm-srgb" ? encode(x) : x))));
      return values.map(x => format === "rgba16float" ? halfOf(x) : code(x));
    },
    async load(format, codes) {
      return Uint32Array.from(codes, code => bitsOf(format === "r16float" ? (habits.flushHalf && code < 0x400 ? 0 : halves[code]) : habits.unorm(code)));
    },
    async sample(format, levels, coordinates) {
      const [first, second] = levels, texel = (x, y) => first.texels[Math.min(first.height - 1, Math.max(0, y)) * first.width + Math.min(first.width - 1, Math.max(0, x))];
      return Float32Array.from(coordinates, ([u, v, level]) => {
        const x = u * first.width - 0.5, y = v * first.height - 0.5, i = Math.floor(x), j = Math.floor(y);
        if (first.width === 2 && first.height === 2 && !second) return habits.product(x, y);
        const row = k => mix(texel(i, k), texel(i + 1, k), habits.weight(x - i));
        const fine = first.height === 1 ? row(0) : mix(row(j), row(j + 1), habits.weight(y - j));
        return second ? mix(fine, second.texels[0], habits.level(level)) : fine;
      });
    },
  };
}
