// The part of a cursor that does not depend on the number type: pointers to a row, moved along it. It is small and has no buffers, so that
// a compiler keeps it in registers. It is compiled for the base target, because a constructor called by a default member initializer never
// belongs to another target.
#pragma once

#include <cstring>

#include "pass/definition.h"

namespace rainref::pass {

template <class Storage_, int channels_, int reach_>
struct RowPointers {
  using Storage = Storage_;
  static constexpr int channels = channels_, reach = reach_, rows = 2 * reach + 1;
  const Storage* row[rows] = {};
  int x = 0;

  constexpr RowPointers(In) {}
  /// Sets rows y - reach … y + reach, using the nearest row beyond the ends.
  void begin_row(const Image& image, int y) {
    for (int k = 0; k < rows; ++k) {
      const int wanted = y + k - reach, last = image.height() - 1;
      row[k] = image.row<Storage>(wanted < 0 ? 0 : wanted < last ? wanted : last);
    }
  }
  /// Bytes that copy_ends needs for n texels.
  static constexpr std::size_t copied_bytes(int n) { return static_cast<std::size_t>(rows * channels * (n + 2 * reach)) * sizeof(Storage); }
  /// Reads columns x - reach … x + n - 1 + reach from copies in `room`, using the nearest texel beyond the ends.
  void copy_ends(std::byte* room, int width, int n) {
    const int first = x < reach ? 0 : x - reach, end = x + n + reach < width ? x + n + reach : width;  // the columns that exist
    for (int k = 0; k < rows; ++k) {
      Storage* const copy = reinterpret_cast<Storage*>(room) + static_cast<std::ptrdiff_t>(k) * channels * (n + 2 * reach);
      const auto texel = [&](int column) RAINREF_FLAT_LAMBDA { return copy + channels * (column - x + reach); };
      std::memcpy(texel(first), row[k] + channels * first, sizeof(Storage) * static_cast<std::size_t>(channels * (end - first)));
      for (int i = x - reach; i < first; ++i) std::memcpy(texel(i), texel(first), sizeof(Storage) * channels);
      for (int i = end; i < x + n + reach; ++i) std::memcpy(texel(i), texel(end - 1), sizeof(Storage) * channels);
      row[k] = copy + channels * (reach - x);
    }
  }
};
struct SampledPointer {
  const Texture* texture = nullptr;
  constexpr SampledPointer(In) {}
  operator const Texture&() const { return *texture; }
  /// Address rules and channels as the pass knows them. A texture that this variant lacks gives an empty view.
  template <Address u, Address v, int count>
  RAINREF_FLAT FixedTexture<u, v, count> fixed() const {
    return texture ? fixed_texture<u, v, count>(*texture) : FixedTexture<u, v, count>();
  }
  /// The rule of this run, for a pass that knows several.
  Address rule() const { return texture ? texture->address_u : Address::clamp; }
};
template <class Storage>
struct StoredPointer {
  const StoredTexture<Storage>* stored = nullptr;
  Address address = Address::clamp;
  constexpr StoredPointer(In) {}
  template <Address u, Address v, int count>
  RAINREF_FLAT FixedStoredTexture<Storage, u, v, count> fixed() const {
    return fixed_texture<u, v, count>(*stored);
  }
  Address rule() const { return address; }
};
template <class Record>
struct RecordPointer {
  std::span<const Record> records{};
  constexpr RecordPointer(In) {}
  const Record* data() const { return records.data(); }
  int size() const { return static_cast<int>(records.size()); }
};
/// For a list whose records the shell loads and stores.
struct NoCursor {
  constexpr NoCursor(Out) {}
  constexpr NoCursor(In, Out) {}
  constexpr NoCursor(In, Out, Out) {}
};
struct OneFormat {};
struct AnyFormat {
  Format format = Format::r8;  ///< of the row
};
template <Format f, Format... others>
struct ResultPointers : std::conditional_t<sizeof...(others) == 0, OneFormat, AnyFormat> {
  using Storage = typename StorageOf<f>::type;
  static constexpr int channels = StorageOf<f>::channels;
  Storage* row = nullptr;
  Rounding rounding = Rounding::rne;
  int x = 0, count = 0;
  constexpr ResultPointers(Out) {}
  constexpr ResultPointers(Out, Out) {}
};

template <class P, class Io>
RAINREF_FLAT void begin_row(const HostIo<P>& host, Io& io, int y, Rounding rounding) {
  each<P>(host, io, [&](const auto& from, auto& to) RAINREF_FLAT_LAMBDA {
    if constexpr (requires { to.rounding; }) {
      if (from.image) to.row = from.image->template row<typename std::remove_reference_t<decltype(to)>::Storage>(y);
      if constexpr (requires { to.format; }) to.format = from.image->format();
      to.rounding = rounding;
    } else if constexpr (requires { to.texture; }) {
      to.texture = from.texture;
    } else if constexpr (requires { to.stored; }) {
      to.stored = &from.view;
      to.address = from.address;
    } else if constexpr (requires { to.records; }) {
      to.records = from.records;
    } else if constexpr (requires { from.image; }) {
      if (from.image) to.begin_row(*from.image, y);
    }
  });
}
template <class P, class Io>
RAINREF_FLAT void move_to(Io& io, int x, int count) {
  each<P>(io, [&](auto& cursor) RAINREF_FLAT_LAMBDA {
    if constexpr (requires { cursor.x; }) cursor.x = x;
    if constexpr (requires { cursor.count; }) cursor.count = count;
  });
}
/// Bytes that copy_ends needs for n texels.
template <class P, class Io>
constexpr std::size_t copied_bytes(int n) {
  std::size_t bytes = 0;
  Io io;
  each<P>(io, [&](auto& cursor) {
    if constexpr (requires { cursor.copied_bytes(n); }) bytes += cursor.copied_bytes(n);
  });
  return bytes;
}
template <class P, class Io>
RAINREF_FLAT void copy_ends(const HostIo<P>& host, Io& io, std::byte* room, int width, int n) {
  each<P>(host, io, [&](const auto& from, auto& cursor) RAINREF_FLAT_LAMBDA {
    if constexpr (requires { cursor.copy_ends(room, width, n); }) {
      if (!from.image) return;
      cursor.copy_ends(room, width, n);
      room += cursor.copied_bytes(n);
    }
  });
}
/// For every image of a run.
template <class P>
int width_of(const HostIo<P>& host) {
  int width = 0;
  each<P>(host, [&](const auto& member) {
    if constexpr (
        requires { member.image; } && !requires { member.view; })
      if (member.image) width = member.image->width();
  });
  return width;
}

}  // namespace rainref::pass
