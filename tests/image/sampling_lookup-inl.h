// One lookup, written over a number N. Text only, like image/sampling-inl.h before it.

template <class N>
RAINREF_FN void look_up(Lookup lookup, const Texture& t, N u, N v, N w, N lod, N (&out)[4]) {
  for (N& channel : out) channel = N(0.0f);
  const auto put = [&out](const auto& texel, int first, int count) RAINREF_LAMBDA {
    for (int i = 0; i < count; ++i) out[first + i] = texel[i];
  };
  const auto put_colour = [&out](const Vec3<N>& colour) RAINREF_LAMBDA {
    out[0] = colour.x;
    out[1] = colour.y;
    out[2] = colour.z;
  };
  const Vec3<N> direction(u, v, w);
  switch (lookup) {
    case Lookup::nearest:
      if (t.channels == 1) return put(sample_nearest<0, 1, N>(t, u, v), 0, 1);
      return put(sample_nearest<0, 4, N>(t, u, v), 0, 4);
    case Lookup::bilinear:
      if (t.channels == 1) return put(sample_bilinear<0, 1, N>(t, u, v), 0, 1);
      return put(sample_bilinear<0, 4, N>(t, u, v), 0, 4);
    case Lookup::bilinear_of_level_1:
      return put(sample_bilinear<0, 1, N>(t, u, v, 1), 0, 1);
    case Lookup::trilinear:
      if (t.channels == 1) return put(sample_trilinear<0, 1, N>(t, u, v, lod), 0, 1);
      return put(sample_trilinear<0, 4, N>(t, u, v, lod), 0, 4);
    case Lookup::mip:
      return put(sample_mip<0, 1, N>(t, u, v, lod), 0, 1);
    case Lookup::middle_channels:
      return put(sample_bilinear<1, 2, N>(t, u, v), 1, 2);
    case Lookup::latlong:
      return put_colour(sample_latlong(t, direction));
    case Lookup::latlong_mip:
      return put_colour(sample_environment(t, false, direction, lod));
    case Lookup::cube:
      return put_colour(sample_environment(t, true, direction, lod));
    case Lookup::clamped:
      return put(sample_bilinear<0, 1, N>(fixed_texture<Address::clamp, Address::clamp, 1>(t), u, v), 0, 1);
    case Lookup::bordered:
      return put(sample_bilinear<0, 1, N>(fixed_texture<Address::border, Address::border, 1>(t), u, v), 0, 1);
    case Lookup::neighbours: {
      const Neighbours<N> near = sample_neighbours<0, N>(fixed_texture<Address::clamp, Address::clamp, 1>(t), u, v);
      out[0] = near.left, out[1] = near.right, out[2] = near.down, out[3] = near.up;
      return;
    }
    case Lookup::pair:
      return put(sample_mip<0, 2, N>(fixed_texture<Address::repeat, Address::repeat, 2>(t), u, v, lod), 0, 2);
    case Lookup::colour:
      return put(sample_trilinear<0, 3, N>(fixed_texture<Address::repeat, Address::repeat, 4>(t), u, v, lod), 0, 3);
  }
}
