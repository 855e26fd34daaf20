// At which mip level the puddle's ground is seen. Text, for every number; inside a namespace that has its functions.

/// footprint: texels of the ground to a pixel at distance 1, seen from straight above; down: of the unit ray to it.
template <class N>
RAINREF_FN N ground_level(N footprint, N distance, N down) {
  return nearest_octave(footprint * distance / max(down, N(0.02f)));
}
