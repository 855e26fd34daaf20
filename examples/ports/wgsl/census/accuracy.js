// How far division and the transcendental functions lie from the exact value, which is the browser's in double precision.
import {bitsOf, drawFloat, drawing, exponentOf, fromBits, gapAt} from "./floats.js";

const count = 16384, f = Math.fround;
const between = (low, high) => draw => f(low + draw() * (high - low));
const floats = (low, high, signed = false) => draw => drawFloat(draw, low, high, signed);
/// Near a zero of the function an error counts as such, not in ULP, and what is smaller than 2^-12 is one bucket.
const byResult = (x, y) => Math.max(exponentOf(y), -13);
const byArgument = x => Math.max(exponentOf(x), -7);
const one = () => 0;

/// Name, expression, exact value, arguments. Of each bucket the worst is kept, because what is allowed hangs on the argument or on the value.
const sweeps = [
  {name: "a / b", exact: (a, b) => a / b, draw: [floats(-20, 20, true), floats(-20, 20, true)], bucket: one},
  {name: "inverseSqrt(a)", exact: a => 1 / Math.sqrt(a), draw: [floats(-40, 40)], bucket: one},
  {name: "sqrt(a)", exact: a => Math.sqrt(a), draw: [floats(-40, 40)], bucket: one},
  {name: "exp(a)", exact: a => Math.exp(a), draw: [between(-80, 80)], bucket: byArgument},
  {name: "exp2(a)", exact: a => 2 ** a, draw: [between(-120, 120)], bucket: byArgument},
  {name: "log(a)", exact: a => Math.log(a), draw: [draw => draw() < 0.5 ? drawFloat(draw, -40, -1) : drawFloat(draw, 1, 40)], bucket: one},
  {name: "log(a), 1/2 to 2", expression: "log(a)", exact: a => Math.log(a), draw: [draw => f(2 ** (2 * draw() - 1))], bucket: byResult},
  {name: "log2(a)", exact: a => Math.log2(a), draw: [draw => draw() < 0.5 ? drawFloat(draw, -40, -1) : drawFloat(draw, 1, 40)], bucket: one},
  {name: "log2(a), 1/2 to 2", expression: "log2(a)", exact: a => Math.log2(a), draw: [draw => f(2 ** (2 * draw() - 1))], bucket: byResult},
  {name: "sin(a), to pi", expression: "sin(a)", exact: a => Math.sin(a), draw: [between(-Math.PI, Math.PI)], bucket: byResult},
  {name: "sin(a), to 100 pi", expression: "sin(a)", exact: a => Math.sin(a), draw: [between(-314, 314)], bucket: byResult},
  {name: "cos(a), to pi", expression: "cos(a)", exact: a => Math.cos(a), draw: [between(-Math.PI, Math.PI)], bucket: byResult},
  {name: "cos(a), to 100 pi", expression: "cos(a)", exact: a => Math.cos(a), draw: [between(-314, 314)], bucket: byResult},
  {name: "atan2(a, b)", exact: (a, b) => Math.atan2(a, b), draw: [floats(-6, 6, true), floats(-6, 6, true)], bucket: one},
  {name: "pow(a, b)", exact: (a, b) => a ** b, draw: [floats(-8, 8), between(-8, 8)], bucket: (x, y) => Math.max(exponentOf(Math.log2(y)), -7)},
];
export const sweepNames = sweeps.map(sweep => sweep.name);

const hex = bits => bits.toString(16).padStart(8, "0");
/// {unit, most, at, worst}: the largest error, in ULP, or absolute where the function has zeros; the arguments there; and of each bucket the
/// worst as the bits "a b result", from which the error can be computed again. 0.5 ULP are rounding alone.
async function sweepOf(tools, sweep, seed) {
  const draw = drawing(seed), rows = [], hasZeros = sweep.bucket === byResult;
  while (rows.length < count) {
    const row = sweep.draw.map(next => next(draw)), y = sweep.exact(...row);
    if (Number.isFinite(y) && y !== 0 && Math.abs(y) > 2 ** -120 && Math.abs(y) < 2 ** 120) rows.push(row);
  }
  const found = await tools.evaluate(sweep.expression ?? sweep.name, rows.map(row => [...row.map(bitsOf), 0, 0, 0].slice(0, 4)));
  const worst = new Map(), all = {most: -1};
  rows.forEach((row, i) => {
    const y = sweep.exact(...row), got = fromBits(found[i]), error = Number.isNaN(got) ? Infinity : Math.abs(got - y), ulps = error / gapAt(y);
    const key = sweep.bucket(row[0], y), weight = hasZeros && key === -13 ? error : ulps;
    if (weight > (worst.get(key)?.weight ?? -1)) worst.set(key, {weight, text: [...row.map(bitsOf), found[i]].map(hex).join(" ")});
    if ((hasZeros ? error : ulps) > all.most) Object.assign(all, {most: hasZeros ? error : ulps, at: row});
  });
  return {
    unit: hasZeros ? "absolute" : "ULP", most: Number.isFinite(all.most) ? Number(all.most.toPrecision(4)) : "Infinity", at: all.at,
    worst: [...worst].sort(([a], [b]) => b - a).map(([, {text}]) => text),
  };
}
export async function accuracy(tools) {
  const given = {};
  for (const [i, sweep] of sweeps.entries()) given[sweep.name] = await sweepOf(tools, sweep, 31 + i);
  return given;
}
