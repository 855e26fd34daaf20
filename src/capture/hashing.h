// Hashes of what passes write.
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

/// "1 wave_step wave 0123...": one line for each frame, pass and buffer. Substeps of a frame run into one hash.
struct HashLine {
  int frame;
  std::string pass, buffer;
  Hash128 hash;
  std::string text() const;
};

/// Hashes every output of every pass, and adds up the passes' times.
class HashRecorder : public Recorder {
 public:
  explicit HashRecorder(bool hashing = true) : hashing_(hashing) {}
  /// With hashing off only the times are kept.
  void set_hashing(bool on) { hashing_ = on; }
  bool reads(int, std::string_view) const override { return hashing_; }
  void pass(const PassCall& call) override;
  /// The lines of the frame so far, in the order of the passes, which are then forgotten; they also enter the scene's hash.
  std::vector<HashLine> take_lines();
  /// Hash of all lines taken so far, each ended by a newline.
  Hash128 scene_hash() const { return scene_.finish(); }

  struct Time {
    std::string pass;
    double seconds = 0;
    int calls = 0;
  };
  const std::vector<Time>& times() const { return times_; }
  /// Those of the part of a run before, to which these are added.
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
