// Films: pictures piped to ffmpeg one after the other.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "rainref/image.h"

namespace rainref::image_io {

/// Pictures per second: the frame rate divided by the number of frames for each picture.
struct FilmRate {
  double fps;
  int every = 1;
  double per_second() const { return fps / every; }
};

/// Checks that can be made before any work. Throws Error(usage) if the name does not end in .mp4, .webm or .gif, or if a GIF cannot have
/// that rate; Error(io) if ffmpeg is not in PATH, or if the name exists and is not a file.
void require_film(const std::filesystem::path& path, FilmRate rate);

/// A film being written to a hidden file beside it; finish() renames that. Until then an existing file of that name is unchanged. Without
/// finish(), nothing remains and ffmpeg is stopped. A missing folder is created.
///
/// ffmpeg gets only the raw pixels of each picture, red, green and blue, top row first, so equal pictures give equal input. It runs in one
/// thread and writes no dates: one version of ffmpeg writes equal files.
class Film {
 public:
  /// Throws like require_film, and Error(io) if the folder cannot be written to or no process can be started.
  Film(const std::filesystem::path& path, int width, int height, FilmRate rate);
  ~Film();

  /// Adds the next picture: rgba8 of the film's size, row 0 on top. Throws Error(io) with ffmpeg's last lines of output if it has ended.
  void add(const Image& picture);
  /// Waits for ffmpeg. Throws like add, also if its exit code is not 0.
  void finish();
  int pictures() const { return pictures_; }

 private:
  class Process;
  std::unique_ptr<Process> process_;
  int width_, height_, pictures_ = 0;
};

}  // namespace rainref::image_io
