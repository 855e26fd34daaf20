// Lanes that go on, packed, so that what follows is done in full vectors of them: where only a part of a picture needs the dear part
// of a pass. No number changes on the way. Text only: include it in a kernel, after lanes-inl.h.

/// Up to 256 elements of Count numbers each, and an integer that says where an element's result belongs.
template <int Count>
class PackedLanes {
 public:
  /// Takes the wanted lanes of a vector; element k of it belongs to first_place + k. There must be room (is_full).
  HWY_INLINE HWY_ATTR void push(Lanes::Mask wanted, const Lanes (&numbers)[Count], std::int32_t first_place) {
    const Lanes::D d;
    RAINREF_UNROLL for (int c = 0; c < Count; ++c) hn::StoreU(hn::Compress(numbers[c].v, wanted.m), d, numbers_[c] + size_);
    const auto places = hn::BitCast(d, hn::Iota(Lanes::DI(), first_place));
    hn::StoreU(hn::BitCast(Lanes::DI(), hn::Compress(places, wanted.m)), Lanes::DI(), places_ + size_);
    size_ += static_cast<int>(hn::CountTrue(d, wanted.m));
  }
  bool is_full() const { return size_ > capacity - Lanes::size(); }
  /// pass(numbers, places, count) for each vector of elements, and forgets them; lanes from count on hold none.
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
  float numbers_[Count][capacity + slack] = {};  // zeros: lanes that hold no element compute, too
  std::int32_t places_[capacity + slack];
};
