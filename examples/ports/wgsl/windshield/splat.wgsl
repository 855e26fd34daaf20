// What both splats share.
struct SplatUniforms {
  size : vec2<f32>,       //   0  [texel] Columns and rows of the height texture.
  radius_scale : f32,     //   8  [m] Radius of a drop of mass 1.
  height_scale : f32,     //  12  [mm] Height of a drop of mass 1.
  frame : vec3<f32>,      //  16  [m/texel] Plane coordinates of a step: x of a column, x and y of a row.
  smallest_radius : f32,  //  28  [m] A smaller drop is drawn this wide, and as much lower.
  kernel : i32,           //  32  [1] 0: paraboloid, 1: quartic, 2: smoothstep, 3: hemisphere, 4: disc.
  blend : i32,            //  36  [1] 0: add, 1: max, 2: add, rounded to half after each drop as a blending unit does.
  drop_count : i32,       //  40  [1] Drops in the list.
  film_scale : f32,       //  44  [mm] corrected: height of a mass unit in a texel.
  gravity : vec2<f32>,    //  48  [1] corrected: pull on a drop of mass 1, in plane axes, over what holds it.
  wind : vec2<f32>,       //  56  [1] corrected: the same of the wind.
  longer : f32,           //  64  [1] Of a drop that is just held, its length more than round; 0 as published.
  taper : f32,            //  68  [1] Its width's slope along its half length; 0 as published.
  skew : f32,             //  72  [1] Its height's slope along its half length; 0 as published.
  moment : f32,           //  76  [1] corrected: mean squared place along it, over its half length squared.
}
@group(0) @binding(0) var<uniform> u: SplatUniforms;
struct Drop {
  position : vec2<f32>,  //   0  [1] Glass coordinates u, v.
  velocity : vec2<f32>,  //   8  [1/s] Change of the position.
  mass : f32,            //  16  [1] as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24.
  life : f32,            //  20  [s] What remains; not above 0: no drop.
  id : u32,              //  24  [1] Its own for ever, ascending in the order of birth.
  padding_0 : f32,       //  28  padding
}
@group(0) @binding(1) var<storage, read> drops: array<Drop>;

fn profile(q_sq: f32) -> f32 {
  let inside = max(1.0 - q_sq, 0.0);
  if (u.kernel == 0) { return inside; }
  if (u.kernel == 1) { return inside * inside; }
  if (u.kernel == 2) {
    let q = clamp(sqrt(q_sq), 0.0, 1.0);
    return 1.0 - q * q * (3.0 - 2.0 * q);
  }
  if (u.kernel == 3) { return sqrt(inside); }
  return select(0.0, 1.0, q_sq <= 1.0);
}

// A drop with a neck: the line through both middles, what is added to q^2 for each of them and that over the way along the line, the width
// of the neck; its height over that of a round drop, and its middle of mass on the line.
struct Two {
  way : vec2f,
  larger : f32,
  larger_slope : f32,
  smaller : f32,
  smaller_slope : f32,
  fillet : f32,
  height : f32,
  balance : f32,
}
fn neck_profile(two: Two, along: f32) -> f32 {
  let a = two.larger - two.larger_slope * along;
  let b = two.smaller - two.smaller_slope * along;
  let rounded_off = max(two.fillet - abs(a - b), 0.0);
  return min(a, b) - rounded_off * rounded_off * (0.25 / two.fillet);
}
// Area under the profile across the line, where 1 - q^2 is c on it.
fn section(c: f32) -> f32 {
  if (u.kernel == 0) { return c * sqrt(c); }
  if (u.kernel == 1) { return c * c * sqrt(c); }
  if (u.kernel == 2) { return c * c * sqrt(c) * pow(c, 1.0 / 3.0); }
  if (u.kernel == 3) { return c; }
  return sqrt(c);
}
fn two_of(neck: Neck) -> Two {
  var two: Two;
  let size = length(neck.offset);
  let apart = neck.left * size;
  two.way = neck.offset * (1.0 / max(size, 1e-6));
  let radii = footprints(neck);
  let to_larger = -neck.share * apart;
  let to_smaller = (1.0 - neck.share) * apart;
  two.larger = to_larger * to_larger + (1.0 - radii.x * radii.x);
  two.smaller = to_smaller * to_smaller + (1.0 - radii.y * radii.y);
  two.larger_slope = 2.0 * to_larger;
  two.smaller_slope = 2.0 * to_smaller;
  two.fillet = max(1.2 * neck.left * (radii.y * radii.y), 1e-6);
  // Volumes of both and of a round drop, from sections.
  let parts = 16;
  let low = to_larger - radii.x;
  let high = to_smaller + radii.y;
  let middle = 0.5 * (low + high);
  let half_length = 0.5 * (high - low);
  var both = 0.0;
  var moment = 0.0;
  var round_drop = 0.0;
  for (var i = 0; i < parts; i++) {
    let at = f32(2 * i + 1 - parts) / f32(parts);
    let along = middle + half_length * at;
    let cut = section(max(1.0 - (along * along + neck_profile(two, along)), 0.0));
    both += cut;
    moment += along * cut;
    round_drop += section(1.0 - at * at);
  }
  two.height = round_drop / max(both * half_length, 1e-6);
  two.balance = moment / max(both, 1e-6);
  return two;
}

// The height that a drop gives to a texel.
fn contribution(drop: Drop, texel: vec2i) -> f32 {
  let root = pow(max(drop.mass, 0.0), 1.0 / 3.0);
  let own = u.radius_scale * root;
  let radius = max(own, u.smallest_radius);
  let share = own / radius;
  if (drop.life <= 0.0) { return 0.0; }
  let height = u.height_scale * root * (share * share);
  let to = vec2f(texel) + 0.5 - drop.position * u.size;
  let plane = vec2f(u.frame.x * to.x + u.frame.y * to.y, u.frame.z * to.y);
  let neck = neck_of(drop.id);
  var two: Two;
  if (neck.left > 0.0) { two = two_of(neck); }
  if (u.longer != 0.0 || u.taper != 0.0 || u.skew != 0.0) {
    let pull = root * root * u.gravity + root * u.wind;
    let size = length(pull);
    var load = min(size, 1.0);
    if (neck.left > 0.0) { load = load * (1.0 - neck.left); }
    let way = select(vec2f(1.0, 0.0), pull * (1.0 / max(size, 1e-6)), size > 1e-6);
    let stretched = 1.0 + u.longer * load;
    let taper = u.taper * load;
    let skew = u.skew * load;
    let inverse = 1.0 / radius;
    let a = (way.x * plane.x + way.y * plane.y) * (inverse / stretched);
    let b = ((way.x * plane.y - way.y * plane.x) * inverse) / max(1.0 + taper * a, 0.0625);
    let even = 1.0 + (taper * skew) * u.moment;
    var kept = height / (stretched * even);
    var q_sq = a * a + b * b;
    if (neck.left > 0.0) {
      let turned = vec2f(dot(two.way, way), two.way.y * way.x - two.way.x * way.y);
      kept = kept * two.height * (even / max(even + (taper + skew) * (turned.x * two.balance), 0.25));
      q_sq = max(q_sq + neck_profile(two, turned.x * a + turned.y * b), 0.0);
    }
    return (kept * max(1.0 + skew * a, 0.0)) * profile(q_sq);
  }
  if (neck.left > 0.0) {
    let place_in = plane * (1.0 / radius);
    return height * two.height * profile(max(dot(place_in, place_in) + neck_profile(two, dot(two.way, place_in)), 0.0));
  }
  return height * profile((plane.x * plane.x + plane.y * plane.y) * (1.0 / (radius * radius)));
}

// The nearest half, ties to even, of x >= 0: what a blending unit leaves in its target.
fn rounded(x: f32) -> f32 {
  let exponent = max(bitcast<u32>(x) >> 23u, 113u);
  let quantum = bitcast<f32>((exponent - 10u) << 23u);
  let inverse = bitcast<f32>((264u - exponent) << 23u);
  return round(x * inverse) * quantum;
}

// All drops in a texel, in the order of the list.
fn blended(texel: vec2i) -> f32 {
  var height = 0.0;
  for (var i = 0; i < u.drop_count; i++) {
    let drop = contribution(drops[i], texel);
    height = select(height + drop, max(height, drop), u.blend == 1);
    if (u.blend == 2) { height = rounded(height); }
  }
  return height;
}
