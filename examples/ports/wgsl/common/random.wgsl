// Random numbers by counter: the same block of four words for the same purpose, a and b, whoever asks and when. The uniform block u
// holds the seed; each draw has a purpose of its own. The generator is pcg4d of Jarzynski and Olano (2020).
fn pcg4d(key: vec4u) -> vec4u {
  var v = key * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> vec4u(16u);
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}
fn random_block(purpose: u32, a: u32, b: u32) -> vec4u {
  let key = pcg4d(vec4u(u.seed, purpose, 0u));
  return pcg4d(vec4u(a ^ key.x, b ^ key.y, key.zw));
}
