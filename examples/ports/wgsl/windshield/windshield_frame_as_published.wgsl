// windshield.windshield_frame, as-published. Gravity, apparent wind and inertia in glass coordinates.
fn project(f: vec3f) -> vec2f { return vec2f(dot(f, u.e_u), dot(f, u.e_v)) * u.inverse_metric.xz; }

@compute @workgroup_size(1)
fn main() {
  let gravity = vec3f(0.0, 0.0, -u.gravity);
  give(project(gravity), project(apparent_wind()), project(u.acceleration), vec4f(0.0), vec4f(0.0));
}
