// A sequence of pictures as a scene names it: files with a number in their names, "frames/%04d.png".
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "effect/inputs.h"

namespace rainref::effect {

/// The keys sequence.*, which say the same of all sequences of a scene.
std::vector<scene::Parameter> sequence_parameters();
/// Throws Error(usage) where the scene gives one of these keys although none of `keys` names a sequence.
void refuse_unused_sequence(const scene::Config& config, std::initializer_list<const char*> keys);

/// Whether the name holds a number as printf writes it: %d, %4d or %04d. "%%" is a percent sign where it does.
bool is_sequence(const std::string& name);
/// The file of a number. Throws Error(usage) for a name with several numbers, or with another directive.
std::string numbered(const std::string& name, std::int64_t number);

/// The pictures that a key names: one file, or one for each frame. What it shows in a frame depends on the frame's number alone.
class PictureSource {
 public:
  /// A single file is read later. Of a sequence every file's header is looked at, none is decoded, and all of them are added to
  /// `inputs` as one. Throws Error naming key and file: Error(io) for one that is missing; Error(usage) for one of another size or with
  /// other channels than the first, for fewer than run.frames shows where nothing says what comes after them, and for another number
  /// of them than `beside` has, where that is a sequence too.
  PictureSource(const scene::Config& config, const std::string& key, Inputs& inputs, const PictureSource* beside = nullptr);

  bool is_sequence() const { return count_ > 0; }
  /// Which of the pictures a frame of the run shows, from 0 on; 0 for a single file. Throws Error(usage) past the last one where
  /// sequence.end is "error".
  std::int64_t shown_in(int frame) const;
  /// That picture, decoded. A single file is added to `inputs`. Throws as read_input.
  image_io::Picture read(std::int64_t picture, Inputs& inputs) const;
  /// What `error` says of a picture's texels, with the file where it is one of a sequence.
  Error about(const Error& error, std::int64_t picture) const;

 private:
  enum class End : std::uint8_t { error, hold, loop };

  std::string file_of(std::int64_t picture) const;
  void look_at_files(Inputs& inputs) const;
  void require_frames(int frames) const;

  NamedFile named_;
  std::int64_t first_ = 0, count_ = 0;  ///< 0: a single file
  double rate_ = 0, fps_ = 1;
  End end_ = End::error;
};

}  // namespace rainref::effect
