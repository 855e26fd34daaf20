// Light at a water surface; the uniform block u holds the refractive index of water.

// Snell's refraction of unit v at unit n (against v); zero at total reflection.
fn bend(v: vec3f, n: vec3f, eta: f32) -> vec3f {
  let cosine = dot(n, v);
  let k = 1.0 - eta * eta * (1.0 - cosine * cosine);
  if (k < 0.0) { return vec3f(0.0); }
  return eta * v - (eta * cosine + sqrt(max(k, 0.0))) * n;
}
fn fresnel(cos_i: f32) -> f32 {
  let eta = u.water_ior;
  let cos_t = sqrt(max(1.0 - (1.0 - cos_i * cos_i) * (1.0 / (eta * eta)), 0.0));
  let parallel = (eta * cos_i - cos_t) / max(eta * cos_i + cos_t, 1e-20);
  let perpendicular = (cos_i - eta * cos_t) / max(cos_i + eta * cos_t, 1e-20);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}
