// What both splats share. Seeded bugs of both: 1501 to 1519.
layout(std140, binding = 0) uniform SplatUniforms {
  vec2 size;              //   0  [texel] Columns and rows of the height texture.
  float radius_scale;     //   8  [m] Radius of a drop of mass 1.
  float height_scale;     //  12  [mm] Height of a drop of mass 1.
  vec3 frame;             //  16  [m/texel] Plane coordinates of a step: x of a column, x and y of a row.
  float smallest_radius;  //  28  [m] A smaller drop is drawn this wide, and as much lower.
  int kernel;             //  32  [1] 0: paraboloid, 1: quartic, 2: smoothstep, 3: hemisphere, 4: disc.
  int blend;              //  36  [1] 0: add, 1: max, 2: add, rounded to half after each drop as a blending unit does.
  int drop_count;         //  40  [1] Drops in the list.
  float film_scale;       //  44  [mm] corrected: height of a quantum in a texel.
} u;
struct Drop {
  vec2 position;    //   0  [1] Glass coordinates u, v.
  vec2 velocity;    //   8  [1/s] Change of the position.
  float mass;       //  16  [1] as-published: 1 is an ordinary drop; corrected: whole quanta of 2e-11 kg, at most 2^24.
  float life;       //  20  [s] What remains; not above 0: no drop.
  uint id;          //  24  [1] Its own for ever, ascending in the order of birth.
  float padding_0;  //  28  padding
};
layout(std430, binding = 1) readonly buffer DropBuffer { Drop drops[]; };

float profile(float q_sq) {
  float inside = max(1.0 - q_sq, 0.0);
  int kernel = BUG == 1505 ? 1 : u.kernel;
  if (kernel == 0) return inside;
  if (kernel == 1) return inside * inside;
  if (kernel == 2) {
    float q = clamp(sqrt(q_sq), 0.0, 1.0);
    return 1.0 - q * q * (3.0 - 2.0 * q);
  }
  if (kernel == 3) return sqrt(inside);
  return q_sq <= 1.0 ? 1.0 : 0.0;
}

// The height that a drop gives to a texel.
float contribution(Drop drop, ivec2 texel) {
  float root = pow(max(drop.mass, 0.0), BUG == 1501 ? 0.5 : 1.0 / 3.0), own = u.radius_scale * root;
  float radius = max(own, BUG == 1509 ? 1e-6 : u.smallest_radius), share = BUG == 1510 ? 1.0 : own / radius;
  float height = u.height_scale * (BUG == 1515 ? drop.mass : root) * (share * share);
  if (BUG != 1514 && drop.life <= 0.0) height = 0.0;
  vec2 to = vec2(texel) + (BUG == 1502 ? 0.0 : 0.5) - drop.position * u.size;
  vec2 plane = vec2(u.frame.x * to.x + (BUG == 1508 ? 0.0 : u.frame.y) * to.y, (BUG == 1507 ? u.frame.x : u.frame.z) * to.y);
  return height * profile((plane.x * plane.x + plane.y * plane.y) * (1.0 / (radius * radius)));
}

// The nearest half, ties to even, of x >= 0: what a blending unit leaves in its target.
float rounded(float x) {
  uint exponent = max(floatBitsToUint(x) >> 23, 113u);
  float quantum = uintBitsToFloat((exponent - 10u) << 23), inverse = uintBitsToFloat((264u - exponent) << 23);
  return (BUG == 1517 ? floor(x * inverse) : roundEven(x * inverse)) * quantum;
}

// All drops in a texel, in the order of the list.
float blended(ivec2 texel) {
  float height = 0.0;
  int count = BUG == 1504 ? u.drop_count - 1 : u.drop_count;
  for (int i = 0; i < count; ++i) {
    float drop = contribution(drops[BUG == 1516 ? count - 1 - i : i], texel);
    height = u.blend == 1 || BUG == 1506 ? max(height, drop) : height + drop;
    if (u.blend == 2 && BUG != 1503) height = rounded(height);
  }
  return height;
}
