// Computes a channel of a buffer from values that a port stored in another scale, as other quantities or with fewer bits.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "port_dump/encoding.h"
#include "rainref/image.h"
#include "rainref/storage.h"

namespace rainref::port_dump {

/// A value as a port's file stores it: float16, float32 or unorm8, little endian.
struct StoredValue {
  FormatInfo::Kind kind;
  const std::byte* at;
};

/// The value of a channel of the buffer, with the values that the port may have had.
struct Converted {
  float value = 0;  ///< one that the buffer's format holds; NaN or infinity where the stored values are
  /// The port's own value lies in [value - below, value + above]. Both are 0 if the conversion tells it to the bit.
  float below = 0, above = 0;
};

/// source.bias + the sum of source.terms[i].scale * stored[i], stored in `to` (float16, float32 or unorm8), rounded to nearest.
///
/// The port computed something else, and stored that. So each stored value stands for what rounds to it: a half for all values between its
/// two neighbours, or those that `half_store` gives; a code for 0.6 of a code to each side; a float for itself. The port's arithmetic may
/// be off by four units in the last place of each product and of the number. None of this concerns a single float, or a single half in a
/// buffer of halves with the same steps, times a power of two.
Converted convert(const ChannelSource& source, std::span<const StoredValue> stored, FormatInfo::Kind to,
                  std::optional<Rounding> half_store);

}  // namespace rainref::port_dump
