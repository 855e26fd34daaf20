// Pass merge, corrected: which drops touch, what two of them become, and what a sliding drop leaves behind.
// Needs integrate.pass.h.

/// Base radius [m].
template <class N>
RAINREF_FN N base_radius(const MergeUniforms& c, N mass) {
  return N(c.radius) * cube_root_of_mass(mass);
}
/// Plane coordinates [m] of a drop.
template <class N>
RAINREF_FN N plane_x(const MergeUniforms& c, N u, N v) {
  return N(c.frame[0]) * u + N(c.frame[1]) * v;
}
template <class N>
RAINREF_FN N plane_y(const MergeUniforms& c, N v) {
  return N(c.frame[2]) * v;
}

/// Whether two base circles overlap: centres [m] and radii [m].
template <class N>
RAINREF_FN auto touches(N x1, N y1, N radius1, N x2, N y2, N radius2) {
  return square(x1 - x2) + square(y1 - y2) < square(radius1 + radius2);
}

/// a with b in it: mass and momentum are kept, the place is the centre of mass. id and life stay a's. (physics: W8)
template <class N>
RAINREF_FN DropState<N> absorb(const DropState<N>& a, const DropState<N>& b) {
  DropState<N> out = a;
  out.mass = a.mass + b.mass;
  const N share = b.mass / max(out.mass, N(1.0f));
  out.u = mix(a.u, b.u, share);
  out.v = mix(a.v, b.v, share);
  out.velocity_u = mix(a.velocity_u, b.velocity_u, share);
  out.velocity_v = mix(a.velocity_v, b.velocity_v, share);
  return out;
}

/// The film after a step of drying. Trails come on top of it.
template <class N>
RAINREF_FN N dried(const MergeUniforms& c, N film) {
  return max(film - N(c.drying), N(0.0f));
}

/// What a sliding drop leaves on the glass, and where: under its tail, one base radius behind the centre.
template <class N>
struct Trail {
  N mass_units, u, v;  ///< not yet whole where tail() gives them
  RAINREF_FN Trail() {}
};
/// Before rounding down to whole mass units.
template <class N>
RAINREF_FN Trail<N> tail(const MergeUniforms& c, const DropState<N>& d) {
  const N zero(0.0f), one(1.0f), radius = base_radius(c, d.mass);
  const N speed = length_on_glass(c.frame, d.velocity_u, d.velocity_v);
  const N back = radius / max(speed, N(1e-12f));  // seconds since the centre was there
  Trail<N> out;
  out.u = d.u - d.velocity_u * back;
  out.v = d.v - d.velocity_v * back;
  const auto on_glass = (d.life > zero) & (out.u >= zero) & (out.u < one) & (out.v >= zero) & (out.v < one);
  out.mass_units = select(on_glass, (N(c.trail) * radius) * (speed * N(c.dt)), zero);
  return out;
}
/// A drop keeps a mass unit.
template <class N>
RAINREF_FN N whole_trail(N mass, N whole) {
  return max(min(mass - N(1.0f), whole), N(0.0f));
}
template <class N>
RAINREF_FN Trail<N> trail(const MergeUniforms& c, const DropState<N>& d) {
  Trail<N> out = tail(c, d);
  out.mass_units = whole_trail(d.mass, floor(out.mass_units));
  return out;
}
