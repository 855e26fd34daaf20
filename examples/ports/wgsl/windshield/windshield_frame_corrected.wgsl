// windshield.windshield_frame, corrected. Gravity, apparent wind and inertia in glass coordinates.
fn project(f: vec3f) -> vec2f {
  let along = vec2f(dot(f, u.e_u), dot(f, u.e_v));
  let mixed = u.inverse_metric.y;
  return vec2f(u.inverse_metric.x * along.x + mixed * along.y, mixed * along.x + u.inverse_metric.z * along.y);
}
// -alpha x p - w x (w x p) and -2 w x v, with w = (0, 0, yaw rate)
fn spin_force(p: vec3f) -> vec3f {
  let rate_sq = u.yaw_rate * u.yaw_rate;
  let alpha = u.yaw_acceleration;
  return vec3f(alpha * p.y + rate_sq * p.x, rate_sq * p.y - alpha * p.x, 0.0);
}
fn coriolis_force(v: vec3f) -> vec3f {
  let twice = 2.0 * u.yaw_rate;
  return vec3f(twice * v.y, -(twice * v.x), 0.0);
}
fn rows(of_u: vec2f, of_v: vec2f) -> vec4f { return vec4f(of_u.x, of_v.x, of_u.y, of_v.y); }

@compute @workgroup_size(1)
fn main() {
  let a = u.acceleration;
  let still = vec3f(-a.x, -a.y, -(u.gravity + a.z));
  give(project(still + spin_force(u.origin)), project(apparent_wind()), vec2f(0.0),
       rows(project(spin_force(u.e_u)), project(spin_force(u.e_v))),
       rows(project(coriolis_force(u.e_u)), project(coriolis_force(u.e_v))));
}
