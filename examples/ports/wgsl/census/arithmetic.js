// What a device and its compilers make of sums and products: rounding, fusion, order, subnormals, and what is not a number.
import {bitsOf, drawFloat, drawing, fromBits, fused} from "./floats.js";
import {kept} from "./stores.js";

const f = Math.fround;
const nothing = bitsOf(0);
const rowOf = numbers => [...numbers.map(bitsOf), nothing, nothing, nothing].slice(0, 4);

/// Of each expression, what it may be compiled to: all are computed here, and the samples tell them apart.
const forms = {
  "a * b + c": {separate: (a, b, c) => f(f(a * b) + c), fused: (a, b, c) => fused(a, b, c)},
  "c - a * b": {separate: (a, b, c) => f(c - f(a * b)), fused: (a, b, c) => fused(-a, b, c)},
  "a * a - c": {separate: (a, b, c) => f(f(a * a) - c), fused: (a, b, c) => fused(a, a, -c)},
};
const orders = {
  "(a + b) + c": {"as written": (a, b, c) => f(f(a + b) + c), "a + (b + c)": (a, b, c) => f(a + f(b + c)), "(a + c) + b": (a, b, c) => f(f(a + c) + b)},
  "a + (b + c)": {"as written": (a, b, c) => f(a + f(b + c)), "(a + b) + c": (a, b, c) => f(f(a + b) + c), "(a + c) + b": (a, b, c) => f(f(a + c) + b)},
  "(a + b) - a": {"as written": (a, b) => f(f(a + b) - a), "b": (a, b) => b},
  "(a * b) * c": {"as written": (a, b, c) => f(f(a * b) * c), "a * (b * c)": (a, b, c) => f(a * f(b * c)), "(a * c) * b": (a, b, c) => f(f(a * c) * b)},
  "a * b + a * c": {"as written": (a, b, c) => f(f(a * b) + f(a * c)), "fused": (a, b, c) => fused(a, b, f(a * c)),
                    "fused the other way": (a, b, c) => fused(a, c, f(a * b)), "a * (b + c)": (a, b, c) => f(a * f(b + c))},
  "a / 3.0": {"as written": a => f(a / 3), "a * (1.0 / 3.0)": a => f(a * f(1 / 3))},
};
/// Rows whose results differ between all the forms.
function tellingRows(ways, draw) {
  const rows = [];
  for (let tries = 0; rows.length < 256 && tries < 1e6; ++tries) {
    const a = drawFloat(draw, -1, 3, true), b = drawFloat(draw, -1, 3, true);
    // Beside what cancels a, or the product, the last bits are large.
    const c = [f(-f(a * b)), f(a * a), f(-a + drawFloat(draw, -6, -1, true)), drawFloat(draw, -1, 3, true)][tries % 4];
    const results = Object.values(ways).map(way => way(a, b, c));
    if (new Set(results.map(bitsOf)).size === results.length && results.every(x => x === 0 || Math.abs(x) > 2 ** -100)) rows.push([a, b, c]);
  }
  if (rows.length < 256) throw new Error(`only ${rows.length} samples tell the forms apart`);
  return rows;
}
/// The form that every sample has, or how many samples have which.
async function formOf(tools, expression, ways, draw) {
  const rows = tellingRows(ways, draw), found = await tools.evaluate(expression, rows.map(rowOf));
  const counts = Object.entries(ways).map(([name, way]) => [name, rows.filter((row, i) => bitsOf(way(...row)) === found[i]).length]);
  const whole = counts.find(([, count]) => count === rows.length);
  if (whole) return whole[0];
  const neither = rows.length - counts.reduce((sum, [, count]) => sum + count, 0);
  return [...counts, ["none of these", neither]].filter(([, count]) => count > 0).map(([name, count]) => `${name}: ${count}`).join(", ");
}
const formsOf = async (tools, table, seed) => {
  const draw = drawing(seed), given = {};
  for (const [expression, ways] of Object.entries(table)) given[expression] = await formOf(tools, expression, ways, draw);
  return given;
};
/// Whether a product and a sum become one operation.
export const contraction = tools => formsOf(tools, forms, 21);
/// Whether sums, products and quotients are computed as written.
export const order = tools => formsOf(tools, orders, 22);

/// Of sums, differences and products, how many of 4096 are not the nearest float.
export async function rounding(tools) {
  const draw = drawing(23), rows = Array.from({length: 4096}, () => [drawFloat(draw, -12, 12, true), drawFloat(draw, -12, 12, true)]), given = {};
  const operations = {"a + b": (a, b) => f(a + b), "a - b": (a, b) => f(a - b), "a * b": (a, b) => f(a * b)};
  for (const [expression, nearest] of Object.entries(operations)) {
    const found = await tools.evaluate(expression, rows.map(rowOf));
    given[expression] = rows.filter((row, i) => bitsOf(nearest(...row)) !== found[i]).length;
  }
  return given;
}

/// Whether subnormal floats survive: as results of normal ones, as operands, and as both.
export async function subnormals(tools) {
  const draw = drawing(24), of = (low, high) => Array.from({length: 256}, () => drawFloat(draw, low, high));
  const cases = {
    "a * b, the result": [of(-70, -65).map(a => [a, f(2 ** -64)]), "a * b", (a, b) => f(a * b)],
    "a - b, the result": [of(-126, -125).map(a => [a, f(2 ** -126)]), "a - b", (a, b) => f(a - b)],
    "a * b, an operand": [of(-140, -127).map(a => [f(a), f(2 ** 40)]), "a * b", (a, b) => f(a * b)],
    "a + b, all": [of(-140, -128).map((a, i) => [f(a), f((i + 1) * 2 ** -149)]), "a + b", (a, b) => f(a + b)],
  };
  const given = {};
  for (const [name, [rows, expression, exact]] of Object.entries(cases)) {
    const telling = rows.filter(row => exact(...row) !== 0);
    given[name] = kept(Array.from(await tools.evaluate(expression, telling.map(rowOf))), telling.map(row => bitsOf(exact(...row))));
  }
  return given;
}

/// What comes of NaN (a), 1 (b), infinity (c) and 0 (d): WGSL promises none of it.
export async function notNumbers(tools) {
  const expressions = {
    "min(NaN, 1)": "min(a, b)", "min(1, NaN)": "min(b, a)", "max(NaN, 1)": "max(a, b)", "max(1, NaN)": "max(b, a)",
    "clamp(NaN, 0, 1)": "clamp(a, d, b)", "saturate(NaN)": "saturate(a)", "NaN == NaN": "select(0.0, 1.0, a == a)", "1 / 0": "b / d", "0 / 0": "d / d",
    "inf - inf": "c - c", "inf * 0": "c * d", "min(inf, 1)": "min(c, b)", "max(-inf, 1)": "max(-c, b)", "sqrt(-1)": "sqrt(-b)", "log2(0)": "log2(d)",
  };
  const given = {}, row = [0x7fc00000, bitsOf(1), 0x7f800000, nothing];
  for (const [name, expression] of Object.entries(expressions)) given[name] = String(fromBits((await tools.evaluate(expression, [row]))[0]));
  given["NaN == NaN"] = given["NaN == NaN"] === "0" ? "false" : "true";
  return given;
}
