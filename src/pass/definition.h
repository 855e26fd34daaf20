// A pass as one definition. Its file has two parts, which a room includes where it needs them.
//
// Outside every namespace: the declaration, a struct that Takes a block, with `about`, uniforms() and Io<B>, and optionally
//   fault(bound)                                       why a case is invalid although its buffers fit, or ""
//   rounds_inside(uniforms)                            whether it rounds intermediate values as it rounds its stores
//   near(uniforms, list, corrected, columns, tile)     the records of a list that may count in a tile; the others change no bit there.
//                                                      Among those near a larger tile it finds the same
//
// Inside the namespace of a number type (RAINREF_FN defined): the arithmetic, a struct with one of
//   run<N, corrected>(u, io, x, y)                     a texel
//   run(u, io, views, x, y)                            the same with views(io), which is computed once per row
//   run_record<N, corrected>(u, io, record)            a record, whose numbers are State<N>; (u, io) if there is no record before
//
// Io<B> names each buffer once. The binding B says what a buffer is: its declaration (Declared), the host's images (Host), the
// arrays of a captured case (model.h), or a cursor over rows of lanes or of another number (cursor-inl.h). Everything here is
// compiled for the base target and holds no vector.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "capture/pass_case.h"
#include "image/stored_texture.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/texture.h"
#include "scene/uniform_block.h"

namespace rainref::pass {

/// How a variant runs a pass. revision is raised when the order of operations or a constant changes; 0: the variant does not run it.
struct VariantOf {
  int revision = 0;
  capture::Judge judge = capture::Judge::envelope;
};
struct About {
  std::string_view name, sentence;
  VariantOf as_published, corrected;
  std::array<std::string_view, 4> order_free_sums{};  ///< sums whose terms a port may add in any order
  std::string_view independence = "gather";           ///< see capture::PassInfo
};
/// Base of a definition: its uniform block, and functions to list its members.
template <class Block>
struct Takes {
  using Uniforms = Block;
  using U = Block;
  /// See scene::member.
  template <auto P>
  static scene::Member member(std::string unit, scene::Range range, std::string sentence) {
    return scene::member<P>(std::move(unit), range, std::move(sentence));
  }
  static scene::UniformBlock block(std::vector<scene::Member> members) { return scene::uniform_block<Block>(std::move(members)); }
};
/// True if a buffer of `variant` ("" means both) exists in this variant.
constexpr bool is_of(std::string_view variant, bool corrected) { return variant.empty() || (variant == "corrected") == corrected; }

/// A buffer that a pass reads.
struct In {
  std::string_view name;
  std::string_view from = "";     ///< the pass that wrote it; "": written by the host
  bool previous = false;          ///< as the previous run of that pass wrote it
  std::string_view variant = "";  ///< the variant that reads it; "": both
  bool optional = false;          ///< the host may leave it out
  bool same_size = false;         ///< of the size of the pass's outputs, although it is looked up by coordinates
  std::string_view count = "";    ///< for records: the uniform that says how many of them are used
  std::size_t records = 0;        ///< for records: exact number; 0: any number
  Filter filter = Filter::none, mip_filter = Filter::none;
};
/// A buffer that a pass writes. Without a sentence it is declared by another pass, and this pass writes it again.
struct Out {
  std::string_view name, sentence = "", unit = "1";
  std::array<double, 2> range{0, 1};
  std::string_view encoding = "none", colour_space = "none", alpha = "none";
  std::string_view variant = "";     ///< the variant that writes it; "": both
  std::string_view format_key = "";  ///< the scene key that chooses one of several formats
  std::string_view record = "";      ///< for a list: the layout in EffectInfo::records
  bool operator==(const Out&) const = default;
};

/// Storage type of a format's channels.
template <Format f>
struct StorageOf;
// clang-format off
template <> struct StorageOf<Format::r8>      { using type = Unorm8; static constexpr int channels = 1; };
template <> struct StorageOf<Format::rgba8>   { using type = Unorm8; static constexpr int channels = 4; };
template <> struct StorageOf<Format::r16f>    { using type = Half;   static constexpr int channels = 1; };
template <> struct StorageOf<Format::rgba16f> { using type = Half;   static constexpr int channels = 4; };
template <> struct StorageOf<Format::r32f>    { using type = float;  static constexpr int channels = 1; };
template <> struct StorageOf<Format::rgba32f> { using type = float;  static constexpr int channels = 4; };
// clang-format on

// ---- iteration over the members of Io -------------------------------------------------------------------------------------
// Always inlined and without library code: the compiler must see through it, or it keeps members in memory in the inner loop.
#define RAINREF_FLAT __attribute__((always_inline)) inline
#define RAINREF_FLAT_LAMBDA __attribute__((always_inline))

namespace detail {
struct Anything {
  template <class T>
  operator T() const;
};
template <class T, std::size_t... I>
constexpr bool holds(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), Anything())...}; };
}
template <class T, int n = 10>
constexpr int count() {
  if constexpr (n == 0 || holds<T>(std::make_index_sequence<n>()))
    return n;
  else
    return count<T, n - 1>();
}
/// Calls f(member, ...) with all n members.
template <int n, class S, class F>
constexpr RAINREF_FLAT void unpack(S& s, const F& f) {
  // clang-format off
  if constexpr (n == 1) { auto& [a] = s; f(a); }
  else if constexpr (n == 2) { auto& [a, b] = s; f(a, b); }
  else if constexpr (n == 3) { auto& [a, b, c] = s; f(a, b, c); }
  else if constexpr (n == 4) { auto& [a, b, c, d] = s; f(a, b, c, d); }
  else if constexpr (n == 5) { auto& [a, b, c, d, e] = s; f(a, b, c, d, e); }
  else if constexpr (n == 6) { auto& [a, b, c, d, e, g] = s; f(a, b, c, d, e, g); }
  else if constexpr (n == 7) { auto& [a, b, c, d, e, g, h] = s; f(a, b, c, d, e, g, h); }
  else if constexpr (n == 8) { auto& [a, b, c, d, e, g, h, i] = s; f(a, b, c, d, e, g, h, i); }
  else if constexpr (n == 9) { auto& [a, b, c, d, e, g, h, i, j] = s; f(a, b, c, d, e, g, h, i, j); }
  else { static_assert(n == 10, "more members than unpack knows"); auto& [a, b, c, d, e, g, h, i, j, k] = s; f(a, b, c, d, e, g, h, i, j, k); }
  // clang-format on
}
}  // namespace detail

/// Declarations for list, describe and layouts.
struct Declared {
  /// Loaded by integer texel: its own, or one up to `around` columns and rows away. Beyond the ends the nearest texel is used.
  template <Format f, int around = 0>
  struct Texels : In {
    static constexpr Format format = f;
    static constexpr int reach = around;
    constexpr Texels(In in) : In(in) {}
  };
  /// Looked up by coordinates.
  struct Sampled : In {
    constexpr Sampled(In in) : In(in) {}
  };
  /// The same for an image and its mip levels, which need not be decoded for lanes.
  template <Format f>
  struct Stored : In {
    constexpr Stored(In in) : In(in) {}
  };
  /// Channels of an image of one of these formats, each a separate plane, loaded by integer texel; beyond the ends by the image's address
  /// rule. Not available in lanes.
  template <Format...>
  struct Planes : In {
    static constexpr int reach = 0;
    constexpr Planes(In in) : In(in) {}
  };
  template <class Record>
  struct Records : In {
    constexpr Records(In in) : In(in) {}
  };
  struct Written {
    Out outs[2];  ///< as published, corrected: the meaning may differ
    constexpr Written(Out both) : outs{both, both} {}
    constexpr Written(Out as_published, Out corrected) : outs{as_published, corrected} {}
  };
  /// An image of this format, or of one of several formats.
  template <Format f, Format...>
  struct Result : Written {
    static constexpr Format format = f;
    using Written::Written;
  };
  template <class Record>
  struct List : Written {
    using Written::Written;
  };
  /// A list that the pass reads and writes again; remaining records keep their id.
  template <class Record>
  struct Changed : In, Written {
    constexpr Changed(In in, Out both) : In(in), Written(both) {}
    constexpr Changed(In in, Out as_published, Out corrected) : In(in), Written(as_published, corrected) {}
  };
};

template <class P>
constexpr int count_of = detail::count<typename P::template Io<Declared>>();
/// Calls f(member) for each member of io.
template <class P, class Io, class F>
constexpr RAINREF_FLAT void each(Io& io, const F& f) {
  detail::unpack<count_of<P>>(io, [&](auto&... member) RAINREF_FLAT_LAMBDA { (f(member), ...); });
}
/// Calls f(member of a, member of b) for two structs of one definition.
template <class P, class IoA, class IoB, class F>
constexpr RAINREF_FLAT void each(IoA& a, IoB& b, const F& f) {
  detail::unpack<count_of<P>>(a, [&](auto&... of_a) RAINREF_FLAT_LAMBDA {
    detail::unpack<count_of<P>>(b, [&](auto&... of_b) RAINREF_FLAT_LAMBDA { (f(of_a, of_b), ...); });
  });
}
/// Largest distance [texels] of a load.
template <class P>
constexpr int reach_of = [] {
  int most = 0;
  const typename P::template Io<Declared> io;
  each<P>(io, [&](const auto& m) {
    if constexpr (requires { m.reach; }) most = m.reach > most ? m.reach : most;
  });
  return most;
}();

/// The images that a run reads and writes. A member that is not set does not belong to this variant.
struct Host {
  template <Format f, int around = 0>
  struct Texels {
    static constexpr std::array formats{f};
    In is;
    const Image* image = nullptr;
    constexpr Texels(In in) : is(in) {}
    void operator=(const Image& i) { image = &i; }
  };
  struct Sampled {
    In is;
    const Texture* texture = nullptr;
    const BufferView* recorded = nullptr;  ///< the buffer that the texture was decoded from; null: the texture itself
    Address address = Address::clamp;      ///< for the recorded buffer if no texture was made from it
    constexpr Sampled(In in) : is(in) {}
    void operator=(const Texture& t) { texture = &t; }
  };
  template <Format f>
  struct Stored {
    static constexpr Format format = f;
    using Storage = typename StorageOf<f>::type;
    In is;
    StoredTexture<Storage> view;
    const Image* image = nullptr;
    std::span<const Image> levels{};
    Address address = Address::clamp;  ///< as recorded; lookups that fix no rule of their own go by it
    constexpr Stored(In in) : is(in) {}
    void operator=(const Image& i) {
      view = stored_texture<Storage>(i);
      image = &i;
    }
    /// Sets all levels of one image, and how lookups beyond its edge are resolved.
    void set(const StoredTexture<Storage>& all, std::span<const Image> images, Address beyond = Address::clamp) {
      view = all;
      levels = images;
      address = beyond;
    }
  };
  /// For a pass whose lanes are written by hand: the image as recorded.
  template <Format...>
  struct Planes {
    In is;
    const PassInput* input = nullptr;
    constexpr Planes(In in) : is(in) {}
  };
  template <class Record>
  struct Records {
    In is;
    std::span<const Record> records{};
    bool is_set = false;
    std::vector<Record> near{};  ///< for records of one tile
    Records(In in) : is(in) {}
    void operator=(std::span<const Record> all) {
      records = all;
      is_set = true;
    }
    void choose(std::vector<Record> some) {
      near = std::move(some);
      records = near;
    }
  };
  template <Format... f>
  struct Result {
    static constexpr std::array formats{f...};
    Out is;
    Image* image = nullptr;
    const BufferView* planes = nullptr;  ///< instead of an image, for a pass whose lanes are written by hand
    constexpr Result(Out both) : is(both) {}
    constexpr Result(Out, Out corrected) : is(corrected) {}
    void operator=(Image& i) { image = &i; }
  };
  /// Records made on demand, and their columns for lanes.
  struct Listed {
    std::function<RecordView()> list{};
    std::vector<float*> columns{};  ///< address of record 0's value for each float of a record, in its order and without padding
  };
  /// Called when the run is finished.
  template <class Record>
  struct List : Listed {
    Out is;
    List(Out both) : is(both) {}
    void operator=(const std::vector<Record>& all) {
      list = [&all] { return RecordView{all.data(), all.size(), sizeof(Record)}; };
    }
  };
  /// Called before and after the run, if a recorder reads the list.
  template <class Record>
  struct Changed : Listed {
    static constexpr std::size_t record_bytes = sizeof(Record);
    In is;
    Changed(In in, Out) : is(in) {}
    Changed(In in, Out, Out) : is(in) {}
  };
};
template <class P>
using HostIo = typename P::template Io<Host>;

}  // namespace rainref::pass
