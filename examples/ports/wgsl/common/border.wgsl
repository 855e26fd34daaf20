// WebGPU's samplers have no border, so a lookup by it loads four texels and blends them; beyond the image every texel is `border`.
fn texel_or_border(image: texture_2d<f32>, texel: vec2i, border: f32) -> f32 {
  if (any(texel < vec2i(0)) || any(texel >= vec2i(textureDimensions(image)))) { return border; }
  return textureLoad(image, texel, 0).x;
}
fn bilinear_with_border(image: texture_2d<f32>, at: vec2f, border: f32) -> f32 {
  let size = vec2f(textureDimensions(image));
  let x = clamp(at * size - 0.5, vec2f(-1.0), size);
  let low = floor(x);
  let f = x - low;
  let a = vec2i(low);
  let bottom = mix(texel_or_border(image, a, border), texel_or_border(image, a + vec2i(1, 0), border), f.x);
  let top = mix(texel_or_border(image, a + vec2i(0, 1), border), texel_or_border(image, a + vec2i(1, 1), border), f.x);
  return mix(bottom, top, f.y);
}
