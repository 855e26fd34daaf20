// Cursors over decoded rows for every number type except lanes.
#pragma once

#include "math/scalar.h"
#include "pass/planes.h"
#include "pass/row_pointers.h"

namespace rainref::pass {
namespace number_text {
using scalar::Vec3;

template <class N, class Storage>
inline void load4(const Storage* p, N (&c)[4]) {
  for (int k = 0; k < 4; ++k) c[k] = N::load(p + k);
}
#define RAINREF_FN inline
#include "pass/cursor-inl.h"
#undef RAINREF_FN
}  // namespace number_text

/// Decoded texels are floats, but a code stays a code, because devices may convert it in different ways when they load it.
template <Format f>
using DecodedOf = std::conditional_t<std::is_same_v<typename StorageOf<f>::type, Unorm8>, Unorm8, float>;

template <class N>
struct NumberCursors {
  template <Format f, int reach = 0>
  using Texels = number_text::TexelCursor<N, DecodedOf<f>, StorageOf<f>::channels, reach>;
  using Sampled = SampledPointer;
  template <Format>
  using Stored = SampledPointer;
  template <Format...>
  using Planes = PlanesPointer;
  template <class Record>
  struct Records : RecordPointer<Record> {
    using RecordPointer<Record>::RecordPointer;
    /// Returns whether an invocation uses a record; the pass says whether the record is near enough. A number with faults may use all.
    static bool takes(bool is_near) {
      if constexpr (requires { N::meets_all(); })
        return is_near || N::meets_all();
      else
        return is_near;
    }
  };
  template <class>
  using List = NoCursor;
  template <class>
  using Changed = NoCursor;
  template <Format...>
  struct Result {
    N* out = nullptr;
    int channels = 0;
    Rounding rounding = Rounding::rne;  ///< rounding of the store that follows
    /// A number that tracks operations sees the store.
    static N to_result(const N& value) {
      if constexpr (requires { value.as_stored(); })
        return value.as_stored();
      else
        return value;
    }
    Result(Out) {}
    Result(Out, Out) {}
    void operator()(N v) const { out[0] = to_result(v); }
    /// Stores the first two channels of a format; any others are 0.
    void operator()(N first, N second) const {
      out[0] = to_result(first);
      out[1] = to_result(second);
      for (int c = 2; c < channels; ++c) out[c] = N(0.0f);
    }
    void operator()(const scalar::Vec3<N>& v, N w) const {
      out[0] = to_result(v.x);
      out[1] = to_result(v.y);
      out[2] = to_result(v.z);
      out[3] = to_result(w);
    }
  };
};

}  // namespace rainref::pass
