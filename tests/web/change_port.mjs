// node change_port.mjs PORT: breaks some numbers in the outputs of a port, the same ones every time: of each NPY file one bit in each of three
// places, and in every fifth file the whole second half moved by one byte.
import fs from 'node:fs';
import path from 'node:path';

let state = 12345n;
const draw = (below) => {
  state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
  return Number((state >> 33n) % BigInt(below));
};
const files = fs.readdirSync(process.argv[2], {recursive: true}).filter((name) => name.endsWith('.npy')).sort();
for (const [number, name] of files.entries()) {
  const file = path.join(process.argv[2], name), bytes = fs.readFileSync(file);
  const begin = 10 + bytes.readUInt16LE(8), count = bytes.length - begin;
  if (count === 0) continue;
  for (let k = 0; k < 3; ++k) bytes[begin + draw(count)] ^= 1 << draw(8);
  if (number % 5 === 4) bytes.copyWithin(begin + (count >> 1), begin + (count >> 1) + 1);
  fs.writeFileSync(file, bytes);
}
