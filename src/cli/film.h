// Films: pictures piped into ffmpeg's program, one after the other.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "rainref/image.h"

namespace rainref::cli {

/// Pictures a second: frames a second over how many of them go to one picture.
struct FilmRate {
  double fps;
  int every = 1;
  double per_second() const { return fps / every; }
};

/// What can be known before any work. Throws Error(usage) where the name ends in none of .mp4, .webm and .gif, or where a GIF cannot have
/// that rate; Error(io) where no folder of PATH has ffmpeg, or where something else than a file has the name.
void require_film(const std::filesystem::path& path, FilmRate rate);

/// A film being made. Its bytes go to a hidden file beside it; finish() gives that its name. Until then a file of that name stays as it
/// was, and without it nothing is left, nor does ffmpeg go on. The folder is made where it is missing.
///
/// ffmpeg gets each picture as raw bytes, red, green and blue, top row first, and nothing else, so the same pictures are the same input.
/// It runs in one thread and writes no dates: the same ffmpeg makes the same file.
class Film {
 public:
  /// Throws as require_film, and Error(io) where the place cannot be written to or no process can be made.
  Film(const std::filesystem::path& path, int width, int height, FilmRate rate);
  ~Film();

  /// The next picture: rgba8 of the film's size, row 0 on top. Throws Error(io) with the last lines that ffmpeg printed where it has ended.
  void add(const Image& picture);
  /// Waits for ffmpeg. Throws like add, also where it has ended with another exit code than 0.
  void finish();
  int pictures() const { return pictures_; }

 private:
  class Process;
  std::unique_ptr<Process> process_;
  int width_, height_, pictures_ = 0;
};

}  // namespace rainref::cli
