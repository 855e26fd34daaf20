// node pack_index.mjs PACK...: what a page must know of packs before it loads one, as packs/index.json.
import fs from "node:fs";
import path from "node:path";

// As `rainref list` has them.
const order = ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"];
const packs = process.argv.slice(2).map(folder => {
  const manifest = JSON.parse(fs.readFileSync(path.join(folder, "manifest.json"), "utf8")), name = path.basename(folder);
  const {effect, variant, scene} = manifest;
  const passes = manifest.passes.map(({name, sentence, formula}) => ({name, sentence, formula, cases: manifest.cases.filter(c => c.pass === name).length}));
  return {name, file: `${name}.tar.gz`, effect, variant, scene, passes};
})
  // The plain pack of a variant before those with something special.
  .sort((a, b) => order.indexOf(a.effect) - order.indexOf(b.effect) || (b.name === `${b.effect}-${b.variant}`) - (a.name === `${a.effect}-${a.variant}`));
process.stdout.write(JSON.stringify({packs}, null, 1) + "\n");
