// What the passes that give lists of drops share: one workgroup takes the list; the order of what it gives is free.
const uint workers = 64;
layout(local_size_x = 64) in;

struct Drop {
  vec2 position;    //   0  [1] Glass coordinates u, v.
  vec2 velocity;    //   8  [1/s] Change of the position.
  float mass;       //  16  [1] as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24.
  float life;       //  20  [s] What remains; not above 0: no drop.
  uint id;          //  24  [1] Its own for ever, ascending in the order of birth.
  float padding_0;  //  28  padding
};
layout(std430, binding = 1) readonly buffer DropBuffer { Drop drops[]; };
layout(std430, binding = DROPS_OUT) coherent buffer GivenBuffer {
  uint count;
  uint padding[3];
  Drop given[];
};

// Where the drop was put. The buffer may be too short for a wrong port; the count says so.
uint append(Drop drop) {
  uint at = atomicAdd(count, 1u);
  drop.padding_0 = 0.0;
  if (at < given.length()) given[at] = drop;
  return at;
}
