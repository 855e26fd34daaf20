// A film behind the glass: its pictures at the frames of a run, decoded by ffmpeg.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "effect/inputs.h"
#include "image/fit.h"

namespace rainref::effect {

/// True if the name ends in .mp4, .m4v, .mov, .webm or .mkv.
bool is_film(const std::string& name);

/// ffmpeg reads the file of that name alone, as the kind of film that its ending says. Its processes are killed by the destructor.
class FilmReader {
 public:
  /// Decodes the first `frames` frames to know them. Throws Error with the key: Error(io) if the file cannot be read, or if there is no
  /// ffmpeg; Error(usage) if the file is too large, or if ffmpeg decodes no picture of it or needs more than an hour of processor time.
  FilmReader(const NamedFile& named, double fps, std::int64_t frames);
  ~FilmReader();

  /// The hash of the file's bytes.
  const std::string& hash() const { return hash_; }
  /// Frames that the film lasts; at least `wanted` if it goes on beyond them.
  std::int64_t frames(std::int64_t wanted);
  /// Index of the picture of frame n, of those that frames() counted: the first frame that shows the same. That is the last picture whose
  /// time is no later than n / fps.
  std::int64_t picture_of(std::int64_t frame) const { return pictures_[static_cast<std::size_t>(frame)]; }
  /// Decodes that picture, fastest in ascending order. Throws Error(io) if ffmpeg fails.
  image_io::Picture read(std::int64_t picture);

 private:
  class Decoder;
  void look_at(std::int64_t frames);

  NamedFile named_;
  double fps_;
  std::string hash_;
  Size size_{0, 0};
  std::vector<std::int64_t> pictures_;  ///< by frame
  bool has_ended_ = false;              ///< they are all
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace rainref::effect
