// All probes of a device's habits.
import {accuracy} from "./accuracy.js";
import {contraction, notNumbers, order, rounding, subnormals} from "./arithmetic.js";
import {filters} from "./filters.js";
import {halfStores, loads, srgbStores, unormStores} from "./stores.js";

/// In the order in which they run: the habit's key, what it is in words, the probe.
export const probes = [
  {key: "half_store", words: "stores to halves", run: halfStores},
  {key: "unorm8_store", words: "stores to 8 bits", run: unormStores},
  {key: "srgb8_store", words: "stores to sRGB", run: srgbStores},
  {key: "load", words: "loads", run: loads},
  {key: "filter", words: "weights of samplers", run: filters},
  {key: "rounding", words: "rounding of sums and products", run: rounding},
  {key: "contraction", words: "fused products and sums", run: contraction},
  {key: "order", words: "order of operations", run: order},
  {key: "subnormals", words: "subnormal floats", run: subnormals},
  {key: "not_numbers", words: "NaN and infinities", run: notNumbers},
  {key: "accuracy", words: "accuracy of functions", run: accuracy},
];

/// Runs them on `tools` (tools.js). step(words) is called before each, and may throw to end it.
export async function runProbes(tools, step = () => {}) {
  const habits = {};
  for (const {key, words, run} of probes) {
    step(words);
    habits[key] = await run(tools);
  }
  return habits;
}
