// node scene_index.mjs SCENES: the scenes that came with rainref, as scenes/index.json says them to a page.
import fs from "node:fs";
import path from "node:path";

const root = process.argv[2];
const scenes = fs.readdirSync(root, {recursive: true}).filter(file => file.endsWith(".toml")).sort().map(file => {
  const text = fs.readFileSync(path.join(root, file), "utf8");
  const value = key => text.match(new RegExp(`^${key} = "(.*)"$`, "m"))?.[1];
  // The first sentence of the comment that it begins with.
  const comment = text.split("\n").slice(0, text.split("\n").findIndex(line => !line.startsWith("#"))).map(line => line.slice(1).trim()).join(" ");
  const named = [...text.matchAll(/^[a-z_]+ = "(.*\.(?:csv|npy|png|exr))"$/gm)].map(match => path.join(path.dirname(file), match[1]));
  return {file, effect: value("effect"), variant: value("variant"), sentence: comment.match(/^.*?\.(?= |$)/)?.[0] ?? comment,
          traced: /^picture = "traced"$/m.test(text), files: named};
});
process.stdout.write(JSON.stringify({scenes}, null, 1) + "\n");
