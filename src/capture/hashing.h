// Hashes of the outputs of passes.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "rainref/recorder.h"

namespace rainref::capture {

/// XXH3-128 of the canonical bytes: rows top down without padding.
Hash128 hash_of(const BufferView& buffer);

/// "1 wave_step wave 0123...": one line for each frame, pass and buffer. The substeps of a frame share one hash.
struct HashLine {
  int frame;
  std::string pass, buffer;
  Hash128 hash;
  std::string text() const;
};

/// Hashes every output of every pass, and sums the passes' times.
class HashRecorder : public Recorder {
 public:
  explicit HashRecorder(bool hashing = true) : hashing_(hashing) {}
  /// If off, only the times are recorded.
  void set_hashing(bool on) { hashing_ = on; }
  bool reads(int, std::string_view) const override { return hashing_; }
  void pass(const PassCall& call) override;
  /// Returns the lines of the frame so far, in the order of the passes, removes them, and adds them to the scene's hash.
  std::vector<HashLine> take_lines();
  /// Hash of all lines taken so far, each with a newline at its end.
  Hash128 scene_hash() const { return scene_.finish(); }

  struct Time {
    std::string pass;
    double seconds = 0;
    int calls = 0;
  };
  const std::vector<Time>& times() const { return times_; }
  /// Sets the times of an earlier part of the run, to which later ones are added.
  void begin_with(std::vector<Time> times) { times_ = std::move(times); }

 private:
  struct Open {
    int frame;
    std::string pass, buffer;
    std::unique_ptr<Hasher> hasher;
  };
  bool hashing_;
  std::vector<Open> open_;
  std::vector<Time> times_;
  Hasher scene_;
};

}  // namespace rainref::capture
