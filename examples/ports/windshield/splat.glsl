// What both splats share.
layout(std140, binding = 0) uniform SplatUniforms {
  vec2 size;              //   0  [texel] Columns and rows of the height texture.
  float radius_scale;     //   8  [m] Radius of a drop of mass 1.
  float height_scale;     //  12  [mm] Height of a drop of mass 1.
  vec3 frame;             //  16  [m/texel] Plane coordinates of a step: x of a column, x and y of a row.
  float smallest_radius;  //  28  [m] A smaller drop is drawn this wide, and as much lower.
  int kernel;             //  32  [1] 0: paraboloid, 1: quartic, 2: smoothstep, 3: hemisphere, 4: disc.
  int blend;              //  36  [1] 0: add, 1: max, 2: add, rounded to half after each drop as a blending unit does.
  int drop_count;         //  40  [1] Drops in the list.
  float film_scale;       //  44  [mm] corrected: height of a mass unit in a texel.
  vec2 gravity;           //  48  [1] corrected: pull on a drop of mass 1, in plane axes, over what holds it.
  vec2 wind;              //  56  [1] corrected: the same of the wind.
  float longer;           //  64  [1] corrected: of a drop that is just held, its length more than round.
  float taper;            //  68  [1] corrected: its width's slope along its half length.
  float skew;             //  72  [1] corrected: its height's slope along its half length.
  float moment;           //  76  [1] corrected: mean squared place along it, over its half length squared.
} u;
struct Drop {
  vec2 position;    //   0  [1] Glass coordinates u, v.
  vec2 velocity;    //   8  [1/s] Change of the position.
  float mass;       //  16  [1] as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24.
  float life;       //  20  [s] What remains; not above 0: no drop.
  uint id;          //  24  [1] Its own for ever, ascending in the order of birth.
  float padding_0;  //  28  padding
};
layout(std430, binding = 1) readonly buffer DropBuffer { Drop drops[]; };

float profile(float q_sq) {
  float inside = max(1.0 - q_sq, 0.0);
  if (u.kernel == 0) return inside;
  if (u.kernel == 1) return inside * inside;
  if (u.kernel == 2) {
    float q = clamp(sqrt(q_sq), 0.0, 1.0);
    return 1.0 - q * q * (3.0 - 2.0 * q);
  }
  if (u.kernel == 3) return sqrt(inside);
  return q_sq <= 1.0 ? 1.0 : 0.0;
}

// The height that a drop gives to a texel.
float contribution(Drop drop, ivec2 texel) {
  float root = pow(max(drop.mass, 0.0), 1.0 / 3.0), own = u.radius_scale * root;
  float radius = max(own, u.smallest_radius), share = own / radius;
  float height = u.height_scale * root * (share * share);
  if (drop.life <= 0.0) height = 0.0;
  vec2 to = vec2(texel) + 0.5 - drop.position * u.size;
  vec2 plane = vec2(u.frame.x * to.x + u.frame.y * to.y, u.frame.z * to.y);
  if (u.longer != 0.0 || u.taper != 0.0 || u.skew != 0.0) {
    vec2 pull = root * root * u.gravity + root * u.wind;
    float size = length(pull), load = min(size, 1.0);
    vec2 way = size > 1e-6 ? pull * (1.0 / max(size, 1e-6)) : vec2(1.0, 0.0);
    float stretched = 1.0 + u.longer * load, taper = u.taper * load, skew = u.skew * load, inverse = 1.0 / radius;
    float a = (way.x * plane.x + way.y * plane.y) * (inverse / stretched);
    float b = ((way.x * plane.y - way.y * plane.x) * inverse) / max(1.0 + taper * a, 0.0625);
    height = height / (stretched * (1.0 + (taper * skew) * u.moment));
    return (height * max(1.0 + skew * a, 0.0)) * profile(a * a + b * b);
  }
  return height * profile((plane.x * plane.x + plane.y * plane.y) * (1.0 / (radius * radius)));
}

// The nearest half, ties to even, of x >= 0: what a blending unit leaves in its target.
float rounded(float x) {
  uint exponent = max(floatBitsToUint(x) >> 23, 113u);
  float quantum = uintBitsToFloat((exponent - 10u) << 23), inverse = uintBitsToFloat((264u - exponent) << 23);
  return roundEven(x * inverse) * quantum;
}

// All drops in a texel, in the order of the list.
float blended(ivec2 texel) {
  float height = 0.0;
  for (int i = 0; i < u.drop_count; ++i) {
    float drop = contribution(drops[i], texel);
    height = u.blend == 1 ? max(height, drop) : height + drop;
    if (u.blend == 2) height = rounded(height);
  }
  return height;
}
