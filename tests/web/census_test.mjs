// node census_test.mjs [DEVICES]: each probe of the census says of a device in JavaScript what that device does, devices of different habits are
// told apart, and a file of the census that lacks or adds something is refused. DEVICES: a folder of files that must all be accepted.
import assert from "node:assert";
import fs from "node:fs";
import path from "node:path";
import {sweepNames} from "../../examples/ports/wgsl/census/accuracy.js";
import {checkCensus, schema} from "../../examples/ports/wgsl/census/check.js";
import {probes, runProbes} from "../../examples/ports/wgsl/census/probes.js";
import {censusText, totals} from "../../examples/ports/wgsl/census/take.js";
import {emulated, exactDevice, truncating} from "./emulated_device.mjs";

const habitsOf = changed => runProbes(emulated({...exactDevice, ...changed}));
const exact = await habitsOf({});

const same = (found, expected, words) => assert.deepStrictEqual(found, expected, words);
const nearest = {rounding: "to nearest, ties to even", overflow: "infinity", beyond: "infinity", subnormals: "kept"};
same(exact.half_store, {render: nearest, storage: nearest, pack2x16float: nearest});
same(exact.unorm8_store.render.half, 128);
assert(exact.unorm8_store.render.furthest > 0.4999 && exact.unorm8_store.render.furthest < 0.50002);
assert(exact.srgb8_store.render.furthest > 0.4999 && exact.srgb8_store.render.furthest < 0.50002);
same(exact.load, {half_subnormals: "kept", unpack2x16float_subnormals: "kept", unorm8: "the nearest float", unorm8_ulp: 0});
const asFloats = {bits: null, rounding: "as floats", furthest: 0};
same(exact.filter, {format: "r32float", texels: asFloats, far_texels: asFloats, product: asFloats, levels: asFloats});
same(exact.rounding, {"a + b": 0, "a - b": 0, "a * b": 0});
same(new Set(Object.values(exact.contraction)), new Set(["separate"]));
same(new Set(Object.values(exact.order)), new Set(["as written"]));
same(new Set(Object.values(exact.subnormals)), new Set(["kept"]));
same([exact.not_numbers["min(NaN, 1)"], exact.not_numbers["NaN == NaN"], exact.not_numbers["1 / 0"]], ["1", "false", "Infinity"]);
for (const name of sweepNames) {
  const {unit, most} = exact.accuracy[name];
  assert(unit === "ULP" ? most > 0.49 && most <= 0.5 : most < 2 ** -24, `${name}: ${most} ${unit}`);
}

// Stores to halves: every rule that the probe knows, and one that it does not.
const rules = {
  "toward zero": truncating,
  "to nearest, ties away from zero": (x, below, above) => x - below >= above - x,
  "to nearest, ties toward zero": (x, below, above) => x - below > above - x,
  "away from zero": () => true,
  "up": (x, below, above, negative) => !negative,
  "down": (x, below, above, negative) => negative,
};
for (const [name, half] of Object.entries(rules)) same((await probes.find(p => p.key === "half_store").run(emulated({...exactDevice, half}))).render.rounding, name);
const odd = await habitsOf({half: (x, below, above) => x - below > 0.6 * (above - below), overflow: 0x7bff, flushHalf: true});
assert(odd.half_store.render.rounding.startsWith("by no rule"));
same([odd.half_store.render.overflow, odd.half_store.render.subnormals], ["the largest half", "flushed to zero"]);
same(odd.load.half_subnormals, "flushed to zero");
same((await habitsOf({overflow: 0x7fff})).half_store.storage.overflow, "NaN");

// 8 bits that are cut, and a sampler of 8 bits as NVIDIA's: weights to nearest, ties up, levels cut.
const coarse = await habitsOf({
  code: x => Math.floor(x), weight: s => Math.floor(256 * s + 0.5) / 256, level: s => Math.floor(256 * s) / 256,
  unorm: k => Math.fround(k * Math.fround(1 / 255)), product: (x, y) => Math.floor(256 * (Math.floor(256 * x + 0.5) / 256) * (Math.floor(256 * y + 0.5) / 256) + 0.5) / 256,
});
assert(coarse.unorm8_store.render.furthest > 0.75 && coarse.srgb8_store.render.furthest > 0.75);
same(coarse.unorm8_store.storage.half, 127);
same([coarse.load.unorm8, coarse.load.unorm8_ulp], ["code * (1 / 255) in floats", 1]);
same(coarse.filter.texels, {bits: 8, rounding: "to nearest, ties up", furthest: 2 ** -9});
same(coarse.filter.far_texels, coarse.filter.texels);
same([coarse.filter.levels.bits, coarse.filter.levels.rounding], [8, "cut"]);
same([coarse.filter.product.bits, coarse.filter.product.rounding], [8, "to nearest, ties up"]);
same((await habitsOf({weight: s => Math.floor(16 * s) / 16, filtersFloats: false})).filter.texels.bits, 4);

// Compilers: fused, rearranged, subnormals flushed, NaN that spreads, functions that are off by three ULP.
const loose = await habitsOf({fuse: true, flush: true, nan: "itself", error: 3});
same(loose.contraction, {"a * b + c": "fused", "c - a * b": "fused", "a * a - c": "fused"});
same(loose.order["a * b + a * c"], "fused");
same(new Set(Object.values(loose.subnormals)), new Set(["flushed to zero"]));
same(loose.not_numbers["min(1, NaN)"], "NaN");
for (const name of ["sqrt(a)", "exp2(a)", "atan2(a, b)"]) assert(loose.accuracy[name].most > 2.5 && loose.accuracy[name].most <= 3.5, name);
same((await habitsOf({reorder: true})).order, {"(a + b) + c": "a + (b + c)", "a + (b + c)": "as written", "(a + b) - a": "b", "(a * b) * c": "as written",
                                                  "a * b + a * c": "a * (b + c)", "a / 3.0": "a * (1.0 / 3.0)"});

// A file: accepted whole, refused with the place that is wrong.
const whole = {
  schema, date: "2026-11-25", rainref: {version: "0", golden_generation: 1}, by: {program: "a test", user_agent: ""},
  device: {vendor: "", architecture: "", device: "", description: "", fallback: false, features: []}, habits: exact, profile: "webgpu",
  ports: [{pack: "one", verdicts: {PASS: 2, FAIL: 1}, others: [{pass: "shade", status: "FAIL", reason: "", elements: 3, outside: 1}]}, {pack: "two", verdicts: {PASS: 1}, others: []}],
};
checkCensus(whole);
same(totals(whole), {PASS: 3, FAIL: 1});
same(JSON.parse(censusText(whole)), whole, "the text is another census");
const refused = (change, words) => {
  const broken = structuredClone(whole);
  change(broken);
  assert.throws(() => checkCensus(broken), words);
};
refused(c => { c.schema = "rainref.census/2"; }, /schema: expected rainref.census\/1, found "rainref.census\/2"/);
refused(c => { delete c.habits.filter; }, /census\.habits\.filter: expected an object, found nothing/);
refused(c => { c.habits.filter.texels.bits = 8.5; }, /census\.habits\.filter\.texels\.bits: expected a count, found 8.5/);
refused(c => { c.device.colour = ""; }, /census\.device: unknown key colour/);
refused(c => { c.ports[0].others = []; }, /census\.ports\.one: 1 passes are not PASS, 0 are named/);
refused(c => { c.ports[1].verdicts = {GOOD: 1}; }, /expected one of PASS/);
refused(c => { c.habits.accuracy["sqrt(a)"].worst = ["3f8"]; }, /expected bits/);

let files = 0;
for (const name of process.argv[2] ? fs.readdirSync(process.argv[2]).filter(file => file.endsWith(".json")) : []) {
  const text = fs.readFileSync(path.join(process.argv[2], name), "utf8");
  checkCensus(JSON.parse(text));
  same(text, censusText(JSON.parse(text)), `${name}: not as a census is written`);
  ++files;
}
console.log(`census: ${probes.length} probes classify emulated devices rightly; ${files} files accepted`);
