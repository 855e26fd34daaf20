// How the arithmetic of a pass loads texels, for any number type N. Text only, like math/vocabulary-inl.h; include load4 before it.
template <class N, class Storage, int channels, int reach>
struct TexelCursor : pass::RowPointers<Storage, channels, reach> {
  using Base = pass::RowPointers<Storage, channels, reach>;
  using Base::Base;
  /// The texel dx columns and dy rows away.
  RAINREF_FN N operator()(int dx = 0, int dy = 0) const {
    static_assert(channels == 1);
    return N::load(this->row[dy + reach] + (this->x + dx));
  }
  /// The four channels of the cursor's own texel.
  RAINREF_FN void load(N (&c)[4]) const {
    static_assert(channels == 4);
    load4(this->row[reach] + 4 * this->x, c);
  }
  RAINREF_FN Vec3<N> rgb() const {
    N c[4];
    load(c);
    return Vec3<N>(c[0], c[1], c[2]);
  }
};
