// Weights of samplers: between texels, and between levels.

const steps = 2 ** 13;  // of a sweep from one texel, or level, to the next
const shares = Array.from({length: steps + 1}, (_, k) => k / steps);

/// Fractional bits that hold every weight, or null for more than 12: then weights are computed like other floats.
export function bitsOfWeights(weights) {
  for (let bits = 0; bits <= 12; ++bits)
    if (weights.every(w => w * 2 ** bits === Math.round(w * 2 ** bits))) return bits;
  return null;
}
const rules = {
  "to nearest, ties up": x => Math.floor(x + 0.5),
  "to nearest, ties down": x => Math.ceil(x - 0.5),
  "to nearest, ties to even": x => Math.abs(x % 1) === 0.5 ? 2 * Math.round(x / 2) : Math.round(x),
  "cut": x => Math.floor(x),
};
/// {bits, rounding, furthest} of weights for these shares; `furthest`: from the exact share.
export function described(weights, exact) {
  const bits = bitsOfWeights(weights), furthest = weights.reduce((far, w, i) => Math.max(far, Math.abs(w - exact[i])), 0);
  const rounding = bits === null ? "as floats" : Object.keys(rules).find(name => weights.every((w, i) => w * 2 ** bits === rules[name](exact[i] * 2 ** bits)));
  return {bits, rounding: rounding ?? "by no rule", furthest: Number(furthest.toPrecision(9))};
}

/// Between two texels of rows of 2 and of 1024, one of them 1, the others 0; `product`: the weight of a corner, of 2 x 2 texels, against the
/// product of the shares; `levels`: between two levels. Exact shares: all coordinates are floats.
export async function filters(tools) {
  const format = tools.filtersFloats ? "r32float" : "r16float", result = {format};
  const row = async (width, left) => {
    const texels = Array.from({length: width}, (_, i) => i > left ? 1 : 0);
    return Array.from(await tools.sample(format, [{width, height: 1, texels}], shares.map(f => [(left + f + 0.5) / width, 0.5, 0])));
  };
  result.texels = described(await row(2, 0), shares);
  result.far_texels = described(await row(1024, 1000), shares);

  const grid = [], exact = [], fine = 64;
  for (let y = 0; y <= fine; ++y)
    for (let x = 0; x <= fine; ++x) {
      const fx = (x + (x < fine ? 0.25 : 0)) / fine, fy = (y + (y < fine ? 0.25 : 0)) / fine;  // a multiple of 1/256 each
      grid.push([(fx + 0.5) / 2, (fy + 0.5) / 2, 0]);
      exact.push(fx * fy);
    }
  result.product = described(Array.from(await tools.sample(format, [{width: 2, height: 2, texels: [0, 0, 0, 1]}], grid)), exact);

  const levels = [{width: 2, height: 2, texels: [0, 0, 0, 0]}, {width: 1, height: 1, texels: [1]}];
  result.levels = described(Array.from(await tools.sample(format, levels, shares.map(f => [0.5, 0.5, f]))), shares);
  return result;
}
