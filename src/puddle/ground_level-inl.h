// The mip level at which the puddle's ground is seen. Text, for every number type; include it in a namespace that has the type's functions.

/// footprint: texels of the ground per pixel at distance 1, seen from straight above; down: component of the unit ray toward the ground.
template <class N>
RAINREF_FN N ground_level(N footprint, N distance, N down) {
  return nearest_octave(footprint * distance / max(down, N(0.02f)));
}
