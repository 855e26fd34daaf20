// A whole run in one hash.
#pragma once

#include <string>

#include "capture/hashing.h"

namespace rainref::capture {

/// frame(recorder) makes a frame.
template <class Frame>
std::string hash_of_frames(int frames, const Frame& frame) {
  HashRecorder recorder;
  for (int k = 0; k < frames; ++k) {
    frame(&recorder);
    recorder.take_lines();
  }
  return recorder.scene_hash().text();
}

}  // namespace rainref::capture
