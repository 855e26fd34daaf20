#include "image_io/film.h"

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/folders.h"
#include "base/hidden.h"
#include "base/path_text.h"
#include "base/piped_program.h"
#include "base/program_path.h"
#include "image_io/film_command.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_film(const fs::path& film, const std::string& why) {
  throw Error(ExitCode::io, fmt::format("film '{}': {}", path_text(film), why));
}

fs::path found_ffmpeg(const fs::path& film) {
  fs::path program = program_in_path("ffmpeg");
  if (program.empty()) refuse_film(film, "ffmpeg, which makes films, is in no folder of PATH (Debian: apt-get install ffmpeg)");
  return program;
}

}  // namespace

void require_film(const fs::path& path, FilmRate rate) {
  film_arguments(path, 1, 1, rate, path);
  std::error_code none;
  if (const auto what = fs::status(path, none).type(); what != fs::file_type::not_found && what != fs::file_type::regular)
    refuse_film(path, what == fs::file_type::directory ? "a folder has that name" : "what has that name is no file");
  found_ffmpeg(path);
}

/// The ffmpeg process and the file that it writes.
class Film::Process {
 public:
  Process(const fs::path& film, int width, int height, FilmRate rate) : film_(film) {
    require_film(film, rate);
    try {
      target_ = followed(film);
      folders_.emplace(target_.parent_path());
      const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
      remove_leftovers(folder);
      written_.emplace(folder, Hidden::Kind::file);
    } catch (const std::system_error& e) {
      refuse_film(film, fmt::format("cannot write there: {}", e.code().message()));
    }
    const fs::path program = found_ffmpeg(film);
    const std::vector<std::string> arguments = film_arguments(film, width, height, rate, written_->path());
    try {
      ffmpeg_.emplace(program, arguments);
    } catch (const std::runtime_error& e) {
      refuse_film(film, e.what());
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void write(std::span<const std::byte> bytes) {
    try {
      if (!ffmpeg_->write(bytes)) end(true);
    } catch (const std::system_error& e) {
      refuse_film(film_, fmt::format("no picture can be given to ffmpeg: {}", e.code().message()));
    }
  }
  void finish() {
    end(false);
    try {
      sync_to_disk(written_->path());
      written_->become(target_);
    } catch (const std::system_error& e) {
      refuse_film(film_, fmt::format("cannot be written: {}", e.code().message()));
    }
    folders_->keep();
  }

 private:
  /// Also ends the input. `is_early`: ffmpeg did not read all of it.
  void end(bool is_early) {
    const CommandEnd ended = ffmpeg_->end("ffmpeg");
    std::string failure = ended.failure;
    if (failure.empty() && is_early) failure = "ffmpeg ended before it had all pictures";
    if (failure.empty()) return;
    refuse_film(film_, ended.last_lines.empty() ? failure : fmt::format("{}; it printed: {}", failure, fmt::join(ended.last_lines, " | ")));
  }

  fs::path film_, target_;
  std::optional<MadeFolders> folders_;
  std::optional<Hidden> written_;
  std::optional<PipedProgram> ffmpeg_;  // newer than the hidden file, so ffmpeg ends before the file is deleted
};

Film::Film(const fs::path& path, int width, int height, FilmRate rate)
    : process_(std::make_unique<Process>(path, width, height, rate)), width_(width), height_(height) {}
Film::~Film() = default;

void Film::add(const Image& picture) {
  if (picture.width() != width_ || picture.height() != height_ || info(picture.format()).texel_bytes() != 4)
    throw Error(ExitCode::internal, fmt::format("film: expected an rgba8 picture of {}x{}", width_, height_));
  std::vector<std::byte> bytes(static_cast<std::size_t>(3) * width_ * height_);
  std::byte* out = bytes.data();
  for (int y = 0; y < height_; ++y) {
    const std::byte* in = picture.row_bytes(y);
    for (int x = 0; x < width_; ++x, in += 4, out += 3) std::copy_n(in, 3, out);
  }
  process_->write(bytes);
  ++pictures_;
}

void Film::finish() { process_->finish(); }

}  // namespace rainref::image_io
