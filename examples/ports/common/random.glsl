// Random numbers by counter: the same block of four words for the same purpose, a and b, whoever asks and when. The uniform block u
// holds the seed; each draw has a purpose of its own. The generator is pcg4d of Jarzynski and Olano (2020).
uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> 16;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}
uvec4 random_block(uint purpose, uint a, uint b) {
  uvec4 key = pcg4d(uvec4(u.seed, purpose, 0u));
  return pcg4d(uvec4(a ^ key.x, b ^ key.y, key.zw));
}
