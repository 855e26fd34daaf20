// windshield.condense, corrected. The mist of condensed water on the glass, as it has grown since water or a blade last cleared it.
struct CondenseUniforms {
  dt : f32,             //   0  [s] Time since the frame before, so rounded that sums are exact.
  inverse_tau : f32,    //   4  [1/s] 1 over the time constant of the mist.
  limit : f32,          //   8  [s] The time since the glass was cleared grows to this and no further.
  wiped_limit : f32,    //  12  [s] Time since a wipe of glass that was never wiped.
  most : f32,           //  16  [1] What the mist grows to: share of the light that it scatters.
  inverse_water : f32,  //  20  [1/mm] 1 over the height of water that takes all of the mist up.
  padding_0 : f32,      //  24  padding
  padding_1 : f32,      //  28  padding
}
@group(0) @binding(0) var<uniform> u: CondenseUniforms;
@group(0) @binding(1) var height: texture_2d<f32>;
@group(0) @binding(2) var wiped: texture_2d<f32>;
@group(0) @binding(3) var clear_time: texture_2d<f32>;

struct Outputs {
  @location(0) condensation: vec4f,
  @location(1) clear_time: vec4f,
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let texel = vec2i(place.xy);
  let taken = min(textureLoad(height, texel, 0).x * u.inverse_water, 1.0);
  let grown = min(textureLoad(clear_time, texel, 0).x + u.dt, u.limit) * (1.0 - taken);
  let since_wipe = textureLoad(wiped, texel, 0).x;
  let since = min(grown, select(u.limit, since_wipe, since_wipe < u.wiped_limit));
  let mist = u.most * (1.0 - exp(-(since * u.inverse_tau)));
  return Outputs(vec4f(mist, 0.0, 0.0, 0.0), vec4f(since, 0.0, 0.0, 0.0));
}
