// The data that a cell keeps from its frames.
#pragma once

#include <cstdint>
#include <string>

#include "rainref/error.h"

namespace rainref::sweep {

/// "picture", "exr@every=10", "exr:drops.A", "buffer:wave@all", "drops", "hash": one kind of data, and the frames in which it is kept.
struct Keep {
  enum class What : std::uint8_t { picture, exr, buffer, drops, hash } what = What::picture;
  std::string part;        ///< name of the buffer, or of the only channel of the EXR; "": all of it
  std::int64_t every = 0;  ///< kept in frames divisible by this; 0: in the last frame of the run
  SourceLocation at;

  /// For a run of `frames` frames. Hashes are kept for every frame.
  bool wanted(std::int64_t frame, std::int64_t frames) const {
    return what == What::hash || (every > 0 ? frame % every == 0 : frame == frames - 1);
  }
  /// Canonical text.
  std::string text() const;
  /// Name of its file in a cell: picture.000119.png, drops.A.000119.exr, wave.000119.npy, drops.000119.json.
  std::string file(std::int64_t frame) const;
};

/// Throws Error(usage) at that place, with the nearest valid text.
Keep keep_from(const std::string& text, const SourceLocation& at);

}  // namespace rainref::sweep
