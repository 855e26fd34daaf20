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
  float longer;           //  64  [1] Of a drop that is just held, its length more than round; 0 as published.
  float taper;            //  68  [1] Its width's slope along its half length; 0 as published.
  float skew;             //  72  [1] Its height's slope along its half length; 0 as published.
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
#include "neck.glsl"

// Of a drop: nothing is left of it where it has none. Declared by the shader.
Neck neck_of(uint id);

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

// A drop with a neck: the line through both middles, what is added to q^2 for each of them and that over the way along the line, the width
// of the neck; its height over that of a round drop, and its middle of mass on the line.
struct Two {
  vec2 way;
  float larger, larger_slope, smaller, smaller_slope, fillet, height, balance;
};
float neck_profile(Two two, float along) {
  float a = two.larger - two.larger_slope * along, b = two.smaller - two.smaller_slope * along;
  float rounded_off = max(two.fillet - abs(a - b), 0.0);
  return min(a, b) - rounded_off * rounded_off * (0.25 / two.fillet);
}
// Area under the profile across the line, where 1 - q^2 is c on it.
float section(float c) {
  if (u.kernel == 0) return c * sqrt(c);
  if (u.kernel == 1) return c * c * sqrt(c);
  if (u.kernel == 2) return c * c * sqrt(c) * pow(c, 1.0 / 3.0);
  if (u.kernel == 3) return c;
  return sqrt(c);
}
Two two_of(Neck neck) {
  Two two;
  float size = length(neck.offset), apart = neck.left * size;
  two.way = neck.offset * (1.0 / max(size, 1e-6));
  vec2 radii = footprints(neck);
  float to_larger = -neck.share * apart, to_smaller = (1.0 - neck.share) * apart;
  two.larger = to_larger * to_larger + (1.0 - radii.x * radii.x);
  two.smaller = to_smaller * to_smaller + (1.0 - radii.y * radii.y);
  two.larger_slope = 2.0 * to_larger;
  two.smaller_slope = 2.0 * to_smaller;
  two.fillet = max(1.2 * neck.left * (radii.y * radii.y), 1e-6);
  // Volumes of both and of a round drop, from sections.
  const int parts = 16;
  float low = to_larger - radii.x, high = to_smaller + radii.y, middle = 0.5 * (low + high), half_length = 0.5 * (high - low);
  float both = 0.0, moment = 0.0, round_drop = 0.0;
  for (int i = 0; i < parts; ++i) {
    float at = float(2 * i + 1 - parts) / float(parts), along = middle + half_length * at;
    float cut = section(max(1.0 - (along * along + neck_profile(two, along)), 0.0));
    both += cut;
    moment += along * cut;
    round_drop += section(1.0 - at * at);
  }
  two.height = round_drop / max(both * half_length, 1e-6);
  two.balance = moment / max(both, 1e-6);
  return two;
}

// The height that a drop gives to a texel.
float contribution(Drop drop, ivec2 texel) {
  float root = pow(max(drop.mass, 0.0), 1.0 / 3.0), own = u.radius_scale * root;
  float radius = max(own, u.smallest_radius), share = own / radius;
  float height = u.height_scale * root * (share * share);
  if (drop.life <= 0.0) height = 0.0;
  vec2 to = vec2(texel) + 0.5 - drop.position * u.size;
  vec2 plane = vec2(u.frame.x * to.x + u.frame.y * to.y, u.frame.z * to.y);
  Neck neck = neck_of(drop.id);
  Two two;
  if (neck.left > 0.0) two = two_of(neck);
  if (u.longer != 0.0 || u.taper != 0.0 || u.skew != 0.0) {
    vec2 pull = root * root * u.gravity + root * u.wind;
    float size = length(pull), load = min(size, 1.0);
    vec2 way = size > 1e-6 ? pull * (1.0 / max(size, 1e-6)) : vec2(1.0, 0.0);
    if (neck.left > 0.0) load = load * (1.0 - neck.left);
    float stretched = 1.0 + u.longer * load, taper = u.taper * load, skew = u.skew * load, inverse = 1.0 / radius;
    float a = (way.x * plane.x + way.y * plane.y) * (inverse / stretched);
    float b = ((way.x * plane.y - way.y * plane.x) * inverse) / max(1.0 + taper * a, 0.0625);
    float even = 1.0 + (taper * skew) * u.moment, q_sq = a * a + b * b;
    height = height / (stretched * even);
    if (neck.left > 0.0) {
      float below = dot(two.way, way) * two.balance;
      height = height * two.height * (even / max(even + (taper + skew) * below, 0.25));
      vec2 turned = vec2(dot(two.way, way), two.way.y * way.x - two.way.x * way.y);
      q_sq = max(q_sq + neck_profile(two, turned.x * a + turned.y * b), 0.0);
    }
    return (height * max(1.0 + skew * a, 0.0)) * profile(q_sq);
  }
  if (neck.left > 0.0) {
    vec2 place = plane * (1.0 / radius);
    return height * two.height * profile(max(dot(place, place) + neck_profile(two, dot(two.way, place)), 0.0));
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
