// Texture lookups, written once for any number type N. Text only, like math/vocabulary-inl.h; include it beside the pass texts.
//
// Coordinates are normalized; texel i of a side of W texels has its centre at (i + 1/2) / W. With x = a(u) W - 1/2:
//   nearest    texel floor(a(u) W)
//   bilinear   texels floor(x) and floor(x) + 1, weights 1 - f and f with f = x - floor(x); rows likewise
//   mip        bilinear in level floor(lod + 1/2)
//   trilinear  two levels floor(lod) and floor(lod) + 1, weights 1 - g and g with g = lod - floor(lod)
// The address rule a: clamp limits x to [0, W - 1]; repeat takes fract(u); mirror takes 1 - |2 fract(u / 2) - 1|;
// border limits x to [-1, W] and returns the border colour for texels outside. mix is a (1 - t) + b t throughout.

// Every lookup takes a Texture, or a FixedTexture if the pass knows the address rules and the number of channels at compile time. The
// lookup is the same, without the decisions.

// Channels stay in registers only if the loops over them are unrolled, which -O2 does not do.
#ifndef RAINREF_UNROLL
#define RAINREF_UNROLL _Pragma("GCC unroll 4")
#endif

template <class N, int Count>
struct Channels {
  N value[Count];
  RAINREF_FN Channels() {}
  RAINREF_FN N& operator[](int i) { return value[i]; }
  RAINREF_FN const N& operator[](int i) const { return value[i]; }
};

/// One mip level, its size as numbers and as integers.
template <class N>
struct Level {
  typename N::Int width, height, offset, pitch;  ///< pitch: distance of rows [texel]
  N width_number, height_number;
  RAINREF_FN Level() {}
};
/// Distance of rows for textures with texels between their rows.
template <class T>
concept Pitched = requires(const T& t) {
  t.pitch[0];
};
/// The same level for every element.
template <class N, class T>
RAINREF_FN Level<N> uniform_level(const T& t, int level) {
  Level<N> l;
  l.width = N::uniform_int(t.width[level]);
  l.height = N::uniform_int(t.height[level]);
  l.offset = N::uniform_int(t.offset[level]);
  l.pitch = l.width;
  if constexpr (Pitched<T>) l.pitch = N::uniform_int(t.pitch[level]);
  l.width_number = N(static_cast<float>(t.width[level]));
  l.height_number = N(static_cast<float>(t.height[level]));
  return l;
}
/// Whether `level` is the same for every element, and that level. Lanes: see sampling_lanes-inl.h.
template <class N, class T>
RAINREF_FN bool is_uniform(const T&, const typename N::Int&, Level<N>&) {
  return false;
}
/// A separate level for each element, clamped to the existing levels.
template <class N, class T>
RAINREF_FN Level<N> level_of(const T& t, typename N::Int wanted) {
  const auto level = clamp_index(wanted, N::uniform_int(t.levels));
  Level<N> l;
  if (is_uniform<N>(t, level, l)) return l;
  // Each level has half the side of the one above, rounded down, at least 1.
  const auto one = N::uniform_int(1);
  l.width = max_index(shift_right(N::uniform_int(t.width[0]), level), one);
  l.height = max_index(shift_right(N::uniform_int(t.height[0]), level), one);
  l.offset = lookup(t.offset, level);
  l.pitch = l.width;
  if constexpr (Pitched<T>) l.pitch = lookup(t.pitch, level);
  l.width_number = to_number(l.width);
  l.height_number = to_number(l.height);
  return l;
}

/// The address rule a(u): u itself for clamp and border.
template <class N>
RAINREF_FN N address_coordinate(Address address, N u) {
  switch (address) {
    case Address::repeat:
      return fract(u);
    case Address::mirror:
      return N(1.0f) - abs(N(2.0f) * fract(u * N(0.5f)) - N(1.0f));
    case Address::clamp:
    case Address::border:
      break;
  }
  return u;
}
/// The lower texel coordinate x of a bilinear lookup along one side of `size` texels.
template <class N>
RAINREF_FN N texel_coordinate(Address address, N u, N size) {
  const N x = address_coordinate(address, u) * size - N(0.5f);
  if (address == Address::repeat) return x;
  if (address == Address::border) return clamp(x, N(-1.0f), size);
  return clamp(x, N(0.0f), size - N(1.0f));
}
/// For a nearest lookup: limited to one texel beyond the image before truncation to integers; the index rule does the rest.
template <class N>
RAINREF_FN N nearest_coordinate(Address address, N u, N size) {
  return clamp(address_coordinate(address, u) * size, N(-1.0f), size);
}
/// The level that the sampler uses; a number type with an inexact sampler overloads this.
template <class N>
RAINREF_FN N level_of_detail(N lod) {
  return lod;
}
template <class Int>
RAINREF_FN Int texel_index(Address address, Int i, Int size) {
  return address == Address::repeat ? wrap_index(i, size) : clamp_index(i, size);
}

/// A column or a row of texels after the address rules: its part of a texel's index in the array, and whether it was inside the image.
/// Inside is always true except for border.
template <class Int, class M>
struct Line {
  Int place;
  M in;
};
template <class N, class T>
RAINREF_FN auto texel_column(const T& t, const Level<N>& l, typename N::Int x) {
  const auto index = texel_index(t.address_u, x, l.width);
  const auto in = inside(t.address_u == Address::border ? x : index, l.width);
  return Line<typename N::Int, typename N::Mask>{t.channels == 1 ? index : index * t.channels, in};
}
template <class N, class T>
RAINREF_FN auto texel_row(const T& t, const Level<N>& l, typename N::Int y) {
  const auto index = texel_index(t.address_v, y, l.height);
  const auto in = inside(t.address_v == Address::border ? y : index, l.height);
  const auto place = index * l.pitch + l.offset;
  return Line<typename N::Int, typename N::Mask>{t.channels == 1 ? place : place * t.channels, in};
}
/// The border colour if a column or a row lies outside.
template <int First, int Count, class N, class T, class Line>
RAINREF_FN Channels<N, Count> with_border(const T& t, Channels<N, Count> out, const Line& column, const Line& row) {
  if constexpr (requires { t.border; }) {
    if (t.address_u == Address::border || t.address_v == Address::border) {
      const auto in = column.in & row.in;
      RAINREF_UNROLL for (int c = 0; c < Count; ++c) out[c] = select(in, out[c], N(t.border[First + c]));
    }
  }
  return out;
}
/// Channels First ... First + Count - 1 of the texel at a column and a row.
template <int First, int Count, class N, class T, class Line>
RAINREF_FN Channels<N, Count> load_texel(const T& t, const Line& column, const Line& row) {
  const auto place = row.place + column.place;
  Channels<N, Count> out;
  RAINREF_UNROLL for (int c = 0; c < Count; ++c) out[c] = fetch(t.texels + (First + c), place, N());
  return with_border<First, Count, N>(t, out, column, row);
}
/// Operations for which lanes have faster versions; see math/lanes-inl.h.
template <class N, class Stored>
RAINREF_FN N fetch_near(const Stored* texels, typename N::Int offset, N n) {
  return fetch(texels, offset, n);
}
/// The only channel of a texel; the next element usually reads the next texel.
template <class N, class T, class Line>
RAINREF_FN N load_near_texel(const T& t, const Line& column, const Line& row) {
  Channels<N, 1> out;
  out[0] = fetch_near(t.texels, row.place + column.place, N());
  return with_border<0, 1, N>(t, out, column, row)[0];
}
/// A column or row before it becomes an integer. A number type with faults overloads this.
template <class N>
RAINREF_FN N whole_coordinate(N x) {
  return x;
}
/// The same for a column and row that are whole numbers; outside by the texture's address rule.
template <class N, class T>
RAINREF_FN N texel_at(const T& t, N x, N y) {
  const Level<N> l = uniform_level<N>(t, 0);
  return load_near_texel<N>(t, texel_column<N>(t, l, to_int(whole_coordinate(x))), texel_row<N>(t, l, to_int(whole_coordinate(y))));
}

template <int First, int Count, class N, class T>
RAINREF_FN Channels<N, Count> sample_nearest(const T& t, N u, N v) {
  const Level<N> l = uniform_level<N>(t, 0);
  const N x = nearest_coordinate(t.address_u, u, l.width_number), y = nearest_coordinate(t.address_v, v, l.height_number);
  return load_texel<First, Count, N>(t, texel_column<N>(t, l, to_int(floor(x))), texel_row<N>(t, l, to_int(floor(y))));
}

/// Bilinear filtering of texels a, b in one row and c, d in the next. A number type with a sampler's variations overloads this.
template <class N>
RAINREF_FN N blend(TexelPrecision, N a, N b, N c, N d, N fx, N fy) {
  const N low = mix(a, b, fx), high = mix(c, d, fx);  // in separate statements, because the diagnosis counts equal operations in order
  return mix(low, high, fy);
}

template <int First, int Count, class N, class T>
RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v) {
  const N x = texel_coordinate(t.address_u, u, l.width_number), y = texel_coordinate(t.address_v, v, l.height_number);
  const N x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0;
  const auto xi = to_int(x0), yi = to_int(y0);
  const auto left = texel_column<N>(t, l, xi), right = texel_column<N>(t, l, xi + 1);
  const auto low = texel_row<N>(t, l, yi), high = texel_row<N>(t, l, yi + 1);
  const auto a = load_texel<First, Count, N>(t, left, low), b = load_texel<First, Count, N>(t, right, low);
  const auto c = load_texel<First, Count, N>(t, left, high), d = load_texel<First, Count, N>(t, right, high);
  Channels<N, Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; ++k) out[k] = blend(t.precision, a[k], b[k], c[k], d[k], fx, fy);
  return out;
}
template <int First, int Count, class N, class T>
RAINREF_FN Channels<N, Count> sample_bilinear(const T& t, N u, N v, int level = 0) {
  return sample_level<First, Count, N>(t, uniform_level<N>(t, level), u, v);
}
/// Four bilinear lookups of one channel of level 0, each one texel from (u, v) along an axis (textureOffset).
template <class N>
struct Neighbours {
  N left, right, down, up;
};
template <int Channel, class N, class T>
RAINREF_FN Neighbours<N> sample_neighbours(const T& t, N u, N v) {
  const Level<N> l = uniform_level<N>(t, 0);
  const N x = texel_coordinate(t.address_u, u, l.width_number), y = texel_coordinate(t.address_v, v, l.height_number);
  const N x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0;
  const auto xi = to_int(x0), yi = to_int(y0);
  const auto a = texel_column<N>(t, l, xi + -1), b = texel_column<N>(t, l, xi), c = texel_column<N>(t, l, xi + 1),
             d = texel_column<N>(t, l, xi + 2);
  const auto p = texel_row<N>(t, l, yi + -1), q = texel_row<N>(t, l, yi), r = texel_row<N>(t, l, yi + 1), s = texel_row<N>(t, l, yi + 2);
  const auto texel = [&](const auto& column, const auto& row) RAINREF_LAMBDA { return load_texel<Channel, 1, N>(t, column, row)[0]; };
  const N bq = texel(b, q), cq = texel(c, q), br = texel(b, r), cr = texel(c, r);
  const auto filtered = [&](N e, N f, N g, N h) RAINREF_LAMBDA { return blend(t.precision, e, f, g, h, fx, fy); };
  return {filtered(texel(a, q), bq, texel(a, r), br), filtered(cq, texel(d, q), cr, texel(d, r)),
          filtered(texel(b, p), texel(c, p), bq, cq), filtered(br, cr, texel(b, s), texel(c, s))};
}

template <int First, int Count, class N, class T>
RAINREF_FN Channels<N, Count> sample_mip(const T& t, N u, N v, N lod) {
  const N last(static_cast<float>(t.levels - 1)), l = floor(clamp(level_of_detail(lod), N(0.0f), last) + N(0.5f)), zero(0.0f);
  return sample_level<First, Count, N>(t, any(l > zero) ? level_of<N>(t, to_int(l)) : uniform_level<N>(t, 0), u, v);
}
/// If lod is whole only the finer level counts, so lanes that all lie on it need not read the other.
template <int First, int Count, class N, class T>
RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, N lod) {
  const N last(static_cast<float>(t.levels - 1)), l = clamp(level_of_detail(lod), N(0.0f), last), l0 = floor(l), g = l - l0, zero(0.0f);
  const Level<N> fine = any(l0 > zero) ? level_of<N>(t, to_int(l0)) : uniform_level<N>(t, 0);
  Channels<N, Count> out = sample_level<First, Count, N>(t, fine, u, v);
  const auto between = g > zero;
  if (any(between)) {
    const auto coarse = sample_level<First, Count, N>(t, level_of<N>(t, to_int(min(l0 + N(1.0f), last))), u, v);
    RAINREF_UNROLL for (int k = 0; k < Count; ++k) out[k] = select(between, mix(out[k], coarse[k], g), out[k]);
  }
  return out;
}
/// One level of detail for all elements: a uniform.
template <int First, int Count, class N, class T>
RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, float lod) {
  return sample_trilinear<First, Count, N>(t, u, v, N(lod));
}
