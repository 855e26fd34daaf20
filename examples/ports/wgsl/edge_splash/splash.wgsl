// Inputs and outputs of both splashes.
@group(0) @binding(1) var scene: texture_2d<f32>;
@group(0) @binding(2) var depth: texture_2d<f32>;
@group(0) @binding(3) var noise_map: texture_2d<f32>;

struct Outputs {
  @location(0) edge: vec4f,
  @location(1) angle: vec4f,
  @location(2) noise: vec4f,
  @location(3) colour: vec4f,
}
