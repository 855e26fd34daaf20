// How far division and the transcendental functions lie from the exact value, which is the browser's in double precision.
import {bitsOf, drawFloat, drawing, exponentOf, fromBits, gapAt} from "./floats.js";

const count = 16384, f = Math.fround;
const between = (low, high) => draw => f(low + draw() * (high - low));
const floats = (low, high, signed = false) => draw => drawFloat(draw, low, high, signed);
/// Near a zero of the function an error counts as such, not in ULP, and what is smaller than 2^-12 is one bucket.
const nearZeros = {
  unit: "absolute", bucket: (x, y) => Math.max(exponentOf(y), -13), weight: ({error, ulps, y}) => exponentOf(y) < -12 ? error : ulps,
};
const byUlp = {unit: "ULP", bucket: () => 0, weight: ({ulps}) => ulps};
const byArgument = {...byUlp, bucket: x => Math.max(exponentOf(x), -7)};
/// Far from 0 an argument is reduced, with an error that grows with it.
const far = {unit: "absolute", bucket: x => exponentOf(x), weight: ({error, x}) => error / Math.abs(x)};

/// Name, expression, exact value, arguments. Of each bucket what weighs most is kept, because what is allowed hangs on the argument or on the value.
const sweeps = [
  {name: "a / b", exact: (a, b) => a / b, draw: [floats(-20, 20, true), floats(-20, 20, true)], by: byUlp},
  {name: "inverseSqrt(a)", exact: a => 1 / Math.sqrt(a), draw: [floats(-40, 40)], by: byUlp},
  {name: "sqrt(a)", exact: a => Math.sqrt(a), draw: [floats(-40, 40)], by: byUlp},
  {name: "exp(a)", exact: a => Math.exp(a), draw: [between(-80, 80)], by: byArgument},
  {name: "exp2(a)", exact: a => 2 ** a, draw: [between(-120, 120)], by: byArgument},
  {name: "log(a)", exact: a => Math.log(a), draw: [draw => draw() < 0.5 ? drawFloat(draw, -40, -1) : drawFloat(draw, 1, 40)], by: byUlp},
  {name: "log(a), 1/2 to 2", expression: "log(a)", exact: a => Math.log(a), draw: [draw => f(2 ** (2 * draw() - 1))], by: nearZeros},
  {name: "log2(a)", exact: a => Math.log2(a), draw: [draw => draw() < 0.5 ? drawFloat(draw, -40, -1) : drawFloat(draw, 1, 40)], by: byUlp},
  {name: "log2(a), 1/2 to 2", expression: "log2(a)", exact: a => Math.log2(a), draw: [draw => f(2 ** (2 * draw() - 1))], by: nearZeros},
  {name: "sin(a), to pi", expression: "sin(a)", exact: a => Math.sin(a), draw: [between(-Math.PI, Math.PI)], by: nearZeros},
  {name: "sin(a), to 100 pi", expression: "sin(a)", exact: a => Math.sin(a), draw: [between(-314, 314)], by: nearZeros},
  {name: "cos(a), to pi", expression: "cos(a)", exact: a => Math.cos(a), draw: [between(-Math.PI, Math.PI)], by: nearZeros},
  {name: "cos(a), to 100 pi", expression: "cos(a)", exact: a => Math.cos(a), draw: [between(-314, 314)], by: nearZeros},
  {name: "sin(a), to 2^16", expression: "sin(a)", exact: a => Math.sin(a), draw: [floats(9, 16, true)], by: far},
  {name: "cos(a), to 2^16", expression: "cos(a)", exact: a => Math.cos(a), draw: [floats(9, 16, true)], by: far},
  {name: "atan2(a, b)", exact: (a, b) => Math.atan2(a, b), draw: [floats(-6, 6, true), floats(-6, 6, true)], by: byUlp},
  {name: "pow(a, b)", exact: (a, b) => a ** b, draw: [floats(-8, 8), between(-8, 8)], by: {...byUlp, bucket: (x, y) => Math.max(exponentOf(Math.log2(y)), -7)}},
];
export const sweepNames = sweeps.map(sweep => sweep.name);

const hex = bits => bits.toString(16).padStart(8, "0");
/// {unit, most, at, worst}: the largest error, in ULP, or absolute where the function has zeros; the arguments there; and of each bucket the
/// worst as the bits "a b result", from which the error can be computed again. 0.5 ULP are rounding alone.
async function sweepOf(tools, sweep, seed) {
  const draw = drawing(seed), rows = [], {unit, bucket, weight} = sweep.by;
  while (rows.length < count) {
    const row = sweep.draw.map(next => next(draw)), y = sweep.exact(...row);
    if (Number.isFinite(y) && y !== 0 && Math.abs(y) > 2 ** -120 && Math.abs(y) < 2 ** 120) rows.push(row);
  }
  const found = await tools.evaluate(sweep.expression ?? sweep.name, rows.map(row => [...row.map(bitsOf), 0, 0, 0].slice(0, 4)));
  const worst = new Map(), all = {most: -1};
  rows.forEach((row, i) => {
    const x = row[0], y = sweep.exact(...row), got = fromBits(found[i]), error = Number.isNaN(got) ? Infinity : Math.abs(got - y), ulps = error / gapAt(y);
    const key = bucket(x, y), weighs = weight({error, ulps, x, y}), size = unit === "ULP" ? ulps : error;
    if (weighs > (worst.get(key)?.weighs ?? -1)) worst.set(key, {weighs, text: [...row.map(bitsOf), found[i]].map(hex).join(" ")});
    if (size > all.most) Object.assign(all, {most: size, at: row});
  });
  return {
    unit, most: Number.isFinite(all.most) ? Number(all.most.toPrecision(4)) : "Infinity", at: all.at,
    worst: [...worst].sort(([a], [b]) => b - a).map(([, {text}]) => text),
  };
}
export async function accuracy(tools) {
  const given = {};
  for (const [i, sweep] of sweeps.entries()) given[sweep.name] = await sweepOf(tools, sweep, 31 + i);
  return given;
}
