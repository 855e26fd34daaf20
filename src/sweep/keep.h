// The data that a cell keeps from its frames.
#pragma once

#include <cstdint>
#include <string>

#include "rainref/error.h"

namespace rainref::sweep {

/// "picture", "exr@every=10", "buffer:wave@all", "hash": one kind of data, and the frames in which it is kept.
struct Keep {
  enum class What : std::uint8_t { picture, exr, buffer, hash } what = What::picture;
  std::string buffer;      ///< its name
  std::int64_t every = 0;  ///< kept in frames divisible by this; 0: in the last frame of the run
  SourceLocation at;

  /// For a run of `frames` frames. Hashes are kept for every frame.
  bool wanted(std::int64_t frame, std::int64_t frames) const {
    return what == What::hash || (every > 0 ? frame % every == 0 : frame == frames - 1);
  }
  /// Canonical text.
  std::string text() const;
};

/// Throws Error(usage) at that place, with the nearest valid text.
Keep keep_from(const std::string& text, const SourceLocation& at);

}  // namespace rainref::sweep
