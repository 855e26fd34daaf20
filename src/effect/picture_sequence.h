// Pictures of a scene that change from frame to frame: files with a number in their names, "frames/%04d.png", and films.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "effect/film_reader.h"
#include "effect/inputs.h"

namespace rainref::effect {

/// The keys sequence.*, which apply to all sequences of a scene.
std::vector<scene::Parameter> sequence_parameters();
/// Throws Error(usage) if the scene sets one of these keys although none of `keys` names a sequence, or a film that uses it.
void refuse_unused_sequence(const scene::Config& config, std::initializer_list<const char*> keys);

/// True if the name holds a number in printf's form: %d, %4d or %04d. In such a name "%%" is a percent sign. No film is one.
bool is_sequence(const std::string& name);
/// True for a sequence and a film.
bool is_moving(const std::string& name);
/// Name of the file with this number. Throws Error(usage) for a name with several numbers, or with another directive.
std::string numbered(const std::string& name, std::int64_t number);

/// The pictures that a key names: one file, one for each frame, or for scene.image a film (effect/film_reader.h). The picture of a frame
/// depends on the frame's number alone.
class PictureSource {
 public:
  /// A single file is read later. For a sequence the header of every file is checked, no file is decoded, and all files are added to
  /// `inputs` as one entry. Throws Error with key and file: Error(io) for a missing file; Error(usage) for a file whose size or channels
  /// differ from the first, for fewer files than run.frames needs without a rule for the frames after them, and for a sequence whose length
  /// differs from that of `beside`.
  PictureSource(const scene::Config& config, const std::string& key, Inputs& inputs, const PictureSource* beside = nullptr);

  bool is_moving() const { return count_ > 0 || film_; }
  /// Index of the picture of a frame, from 0 on; 0 for a single file. Throws Error(usage) after the last one if sequence.end is "error".
  std::int64_t shown_in(int frame) const;
  /// Decodes that picture. A single file is added to `inputs`. Throws as read_input does.
  image_io::Picture read(std::int64_t picture, Inputs& inputs) const;
  /// Returns `error`, which is about a picture's texels, with the name of the file if it belongs to a sequence.
  Error about(const Error& error, std::int64_t picture) const;

 private:
  enum class End : std::uint8_t { error, hold, loop };

  bool is_sequence() const { return count_ > 0; }
  std::string file_of(std::int64_t picture) const;
  void look_at_files(Inputs& inputs) const;
  void require_frames(int frames) const;

  NamedFile named_;
  std::shared_ptr<FilmReader> film_;
  std::int64_t first_ = 0, count_ = 0;  ///< 0: a single file
  double rate_ = 0, fps_ = 1;
  End end_ = End::error;
};

}  // namespace rainref::effect
