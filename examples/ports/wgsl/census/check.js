// What the file of a census must hold. A version that changes what a key means, or takes one away, gets another number.
import {sweepNames} from "./accuracy.js";

export const schema = "rainref.census/1";

const text = "a text", number = "a number", count = "a count", flag = "true or false", counts = {each: count}, texts = {each: text};
const halves = {rounding: text, overflow: text, beyond: text, subnormals: text}, codes = {furthest: number, at: number, half: count};
const weights = {bits: [count, null], rounding: text, furthest: number};
/// A shape: a kind of value, an object of shapes, {each: shape} for any keys, {list: shape}, or [shape, null]. `?` ends a key that may be missing.
const shape = {
  schema: text, date: text, rainref: {version: text, golden_generation: count}, by: {program: text, user_agent: text},
  device: {vendor: text, architecture: text, device: text, description: text, fallback: flag, features: {list: text}},
  habits: {
    half_store: {render: halves, storage: halves, pack2x16float: halves},
    unorm8_store: {render: codes, storage: codes},
    srgb8_store: {render: codes},
    load: {half_subnormals: text, unpack2x16float_subnormals: text, unorm8: text, unorm8_ulp: number},
    filter: {format: text, texels: weights, far_texels: weights, product: weights, levels: weights},
    rounding: counts, contraction: texts, order: texts, subnormals: texts, not_numbers: texts,
    accuracy: Object.fromEntries(sweepNames.map(name => [name, {
      unit: text, most: [number, "Infinity"], at: {list: number}, worst: {list: text}}])),
  },
  profile: text,
  ports: {list: {pack: text, verdicts: counts, others: {list: {pass: text, status: text, reason: text, "elements?": count, "outside?": count}}}},
};
const statuses = ["PASS", "WARN", "FAIL", "UNTESTED", "DATA", "NOT JUDGED", "NOT RUN"];

const isKind = {
  [text]: value => typeof value === "string",
  [number]: value => typeof value === "number",
  [count]: value => Number.isInteger(value) && value >= 0,
  [flag]: value => typeof value === "boolean",
};
function checkShape(value, expected, place) {
  const found = value === undefined ? "nothing" : JSON.stringify(value).slice(0, 60), fail = words => { throw new Error(`${place}: expected ${words}, found ${found}`); };
  if (typeof expected === "string") return isKind[expected](value) || fail(expected);
  if (Array.isArray(expected)) return value === expected[1] || checkShape(value, expected[0], place);
  if (expected.list) return Array.isArray(value) ? value.forEach((item, i) => checkShape(item, expected.list, `${place}[${i}]`)) : fail("a list");
  if (value === null || typeof value !== "object" || Array.isArray(value)) return fail("an object");
  if (expected.each) return Object.entries(value).forEach(([key, item]) => checkShape(item, expected.each, `${place}.${key}`));
  const known = Object.keys(expected).map(key => key.replace(/\?$/, ""));
  for (const key of Object.keys(value)) if (!known.includes(key)) throw new Error(`${place}: unknown key ${key}; expected ${known.join(", ")}`);
  for (const [key, item] of Object.entries(expected)) {
    const name = key.replace(/\?$/, "");
    if (name === key || name in value) checkShape(value[name], item, `${place}.${name}`);
  }
}
/// Throws with the first place that is not as a census has it.
export function checkCensus(census) {
  if (census?.schema !== schema) throw new Error(`schema: expected ${schema}, found ${JSON.stringify(census?.schema)}`);
  checkShape(census, shape, "census");
  if (!/^\d{4}-\d\d-\d\d$/.test(census.date)) throw new Error(`census.date: expected YYYY-MM-DD, found ${census.date}`);
  for (const [name, {worst}] of Object.entries(census.habits.accuracy))
    for (const sample of worst) if (!/^[0-9a-f]{8}( [0-9a-f]{8}){1,2}$/.test(sample)) throw new Error(`census.habits.accuracy.${name}: expected bits, found ${sample}`);
  for (const {pack, verdicts, others} of census.ports) {
    const place = `census.ports.${pack}`;
    for (const status of Object.keys(verdicts)) if (!statuses.includes(status)) throw new Error(`${place}: expected one of ${statuses.join(", ")}, found ${status}`);
    const named = Object.entries(verdicts).reduce((sum, [status, n]) => sum + (status === "PASS" || status === "DATA" ? 0 : n), 0);
    if (named !== others.length) throw new Error(`${place}: ${named} passes are not PASS, ${others.length} are named`);
  }
}
