// puddle.display, corrected. Vignette and display code.
@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let radiance = textureLoad(colour, pixel, 0).rgb;
  let light = max(vignette(pixel), 0.0) * u.exposure;
  let code = encode_srgb(clamp(light * radiance, vec3f(0.0), vec3f(1.0)));
  return vec4f(code, 1.0);
}
