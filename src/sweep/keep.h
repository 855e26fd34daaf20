// What a cell keeps of its frames.
#pragma once

#include <cstdint>
#include <string>

#include "rainref/error.h"

namespace rainref::sweep {

/// "picture", "exr@every=10", "buffer:wave@all", "hash": one thing, and in which frames.
struct Keep {
  enum class What : std::uint8_t { picture, exr, buffer, hash } what = What::picture;
  std::string buffer;      ///< its name
  std::int64_t every = 0;  ///< frames that it divides; 0: the last frame of the run
  SourceLocation at;

  /// Of a run of `frames` frames. Hashes are of every frame.
  bool wanted(std::int64_t frame, std::int64_t frames) const {
    return what == What::hash || (every > 0 ? frame % every == 0 : frame == frames - 1);
  }
  /// The same text for the same thing.
  std::string text() const;
};

/// Throws Error(usage), placed there, with the nearest thing that can be kept.
Keep keep_from(const std::string& text, const SourceLocation& at);

}  // namespace rainref::sweep
