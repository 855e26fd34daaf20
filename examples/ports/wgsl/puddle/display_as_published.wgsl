// puddle.display, as-published. Vignette and display code.
@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let radiance = textureLoad(colour, pixel, 0).rgb;
  let code = pow(vignette(pixel) * radiance, vec3f(0.4545));
  return vec4f(code, 1.0);
}
