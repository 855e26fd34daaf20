// Packs active lanes, so that expensive work needed only for a part of a picture runs in full vectors. The numbers do not change. Text
// only: include it in a kernel, after lanes-inl.h.

/// At most 256 elements of Count numbers each, and an integer with the place of the element's result.
template <int Count>
class PackedLanes {
 public:
  /// Adds the wanted lanes of a vector; element k belongs to place first_place + k. There must be room (is_full).
  HWY_INLINE HWY_ATTR void push(Lanes::Mask wanted, const Lanes (&numbers)[Count], std::int32_t first_place) {
    const Lanes::D d;
    RAINREF_UNROLL for (int c = 0; c < Count; ++c) hn::StoreU(hn::Compress(numbers[c].v, wanted.m), d, numbers_[c] + size_);
    const auto places = hn::BitCast(d, hn::Iota(Lanes::DI(), first_place));
    hn::StoreU(hn::BitCast(Lanes::DI(), hn::Compress(places, wanted.m)), Lanes::DI(), places_ + size_);
    size_ += static_cast<int>(hn::CountTrue(d, wanted.m));
  }
  bool is_full() const { return size_ > capacity - Lanes::size(); }
  /// Calls pass(numbers, places, count) for each vector of elements and removes them; lanes from count on are unused.
  template <class Pass>
  HWY_INLINE HWY_ATTR void drain(const Pass& pass) {
    const Lanes::D d;
    for (int first = 0; first < size_; first += Lanes::size()) {
      Lanes numbers[Count];
      RAINREF_UNROLL for (int c = 0; c < Count; ++c) numbers[c] = hn::LoadU(d, numbers_[c] + first);
      pass(numbers, places_ + first, size_ - first < Lanes::size() ? size_ - first : Lanes::size());
    }
    size_ = 0;
  }

 private:
  static constexpr int capacity = 256, slack = HWY_MAX_BYTES / sizeof(float);
  int size_ = 0;
  float numbers_[Count][capacity + slack] = {};  // zeros, because unused lanes are computed too
  std::int32_t places_[capacity + slack];
};
