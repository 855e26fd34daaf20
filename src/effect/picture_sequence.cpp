#include "effect/picture_sequence.h"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/hash.h"
#include "base/number_text.h"
#include "base/read_file.h"
#include "effect/npy_picture.h"
#include "scene/check.h"

namespace rainref::effect {
namespace {

constexpr std::int64_t most_pictures = 1'000'000;
constexpr const char* keys_of_sequences[] = {"sequence.first", "sequence.count", "sequence.rate", "sequence.end"};

/// A name in parts: the text before the number, its width, whether zeros fill it, and the text behind.
struct Pattern {
  std::string before, after;
  int width = 0;
  bool has_zeros = false;
};
struct Parsed {
  std::optional<Pattern> pattern;
  int numbers = 0;
  bool has_others = false;  ///< a percent sign that neither belongs to a number nor is doubled
};
Parsed parsed(const std::string& name) {
  Parsed out;
  Pattern p;
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '%') {
      text += name[i];
      continue;
    }
    if (i + 1 < name.size() && name[i + 1] == '%') {
      text += '%';
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end < name.size() && name[end] >= '0' && name[end] <= '9') ++end;
    if (end >= name.size() || name[end] != 'd' || end - i > 3) {
      out.has_others = true;
      text += '%';
      continue;
    }
    const std::string digits = name.substr(i + 1, end - i - 1);
    p = {text, "", whole_from<int>(digits).value_or(0), digits.starts_with('0')};
    text.clear();
    ++out.numbers;
    i = end;
  }
  p.after = text;
  if (out.numbers > 0) out.pattern = p;
  return out;
}

}  // namespace

std::vector<scene::Parameter> sequence_parameters() {
  return {
      scene::integer("sequence.first", "1", 0, 1e9, 0, "Number in the first file's name, if a picture's name holds one (\"%04d.png\")."),
      scene::integer("sequence.count", "1", 0, most_pictures, 0, "Number of pictures in a sequence; 0: all up to the first gap."),
      scene::real("sequence.rate", "1/s", 0, 10000, 0, "Pictures per second; 0: one for each frame of the run."),
      scene::choice("sequence.end", {"error", "hold", "loop"}, "error",
                    "What comes after the last picture: an error, the last picture again, or the first one again."),
  };
}

bool is_sequence(const std::string& name) { return !is_film(name) && parsed(name).numbers > 0; }
bool is_moving(const std::string& name) { return is_film(name) || is_sequence(name); }

std::string numbered(const std::string& name, std::int64_t number) {
  const Parsed p = parsed(name);
  if (p.numbers != 1 || p.has_others)
    throw Error(ExitCode::usage, fmt::format("'{}': expected one number, as %04d, and every other percent sign doubled", name));
  const Pattern& at = *p.pattern;
  return at.before + (at.has_zeros ? fmt::format("{:0{}}", number, at.width) : fmt::format("{:{}}", number, at.width)) + at.after;
}

void refuse_unused_sequence(const scene::Config& config, std::initializer_list<const char*> keys) {
  bool has_film = false;
  for (const char* key : keys) {
    if (is_sequence(config.text(key))) return;
    has_film = has_film || is_film(config.text(key));
  }
  for (const std::string key : keys_of_sequences) {
    if (!config.given(key) || (has_film && key == "sequence.end")) continue;
    scene::refuse(
        config.entry(key).origin, key,
        has_film ? "expected none for a film, which has its own times"
                 : fmt::format("expected none where no picture's name holds a number, as \"%04d.png\" in {}", fmt::join(keys, " or ")));
  }
}

PictureSource::PictureSource(const scene::Config& config, const std::string& key, Inputs& inputs, const PictureSource* beside)
    : named_(config, key), fps_(config.real("run.fps")) {
  if (!effect::is_moving(named_.name) || (is_film(named_.name) && key != "scene.image")) return;
  first_ = config.integer("sequence.first");
  rate_ = config.real("sequence.rate");
  const std::string& end = config.text("sequence.end");
  end_ = end == "hold" ? End::hold : end == "loop" ? End::loop : End::error;
  if (is_film(named_.name)) {
    const std::int64_t frames = config.integer("run.frames");
    film_ = std::make_shared<FilmReader>(named_, fps_, frames);
    inputs.files.push_back({named_.key, named_.name, film_->hash(), true, 0, 1});
    require_frames(static_cast<int>(frames));
    return;
  }
  try {
    numbered(named_.name, first_);
  } catch (const Error& e) {
    throw named_.placed(e.code(), e.what());
  }
  count_ = config.integer("sequence.count");
  if (count_ == 0) {
    std::error_code ignored;
    while (count_ < most_pictures && std::filesystem::exists(named_.path_of(file_of(count_)), ignored)) ++count_;
    count_ = std::max<std::int64_t>(count_, 1);  // look_at_files reports that there is none
  }
  if (beside != nullptr && beside->is_sequence() && beside->count_ != count_)
    throw named_.placed(ExitCode::usage,
                        fmt::format("expected {} pictures as {} has, found {}", beside->count_, beside->named_.key, count_));
  look_at_files(inputs);
  require_frames(static_cast<int>(config.integer("run.frames")));
}

std::string PictureSource::file_of(std::int64_t picture) const { return numbered(named_.name, first_ + picture); }

void PictureSource::look_at_files(Inputs& inputs) const {
  Hasher hasher(0);
  const image_io::Content content = content_of(named_.key);
  image_io::Picture first;
  bool is_lossy = false;
  for (std::int64_t k = 0; k < count_; ++k) {
    const std::string file = file_of(k);
    const std::filesystem::path path = named_.path_of(file);
    image_io::Picture picture;
    try {
      const std::vector<std::byte> bytes = read_file(path);
      hasher.add(file_hash(bytes).text());
      picture = is_npy(path) ? inspect_npy(path, bytes, content) : image_io::inspect(path, bytes, content);
    } catch (const Error& e) {
      throw named_.placed(e.code(), e.what());
    }
    is_lossy = is_lossy || picture.lossy;
    if (k == 0) {
      first = std::move(picture);
      continue;
    }
    if (picture.file_width != first.file_width || picture.file_height != first.file_height) {
      throw named_.placed(ExitCode::usage, fmt::format("'{}': expected {}x{} texels as '{}' has, found {}x{}", file, first.file_width,
                                                       first.file_height, file_of(0), picture.file_width, picture.file_height));
    }
    if (picture.channel_names != first.channel_names) {
      throw named_.placed(ExitCode::usage,
                          fmt::format("'{}': expected the channels {} as '{}' has, found {}", file, fmt::join(first.channel_names, " "),
                                      file_of(0), fmt::join(picture.channel_names, " ")));
    }
  }
  add_input(named_, first, {named_.key, named_.name, hasher.finish().text(), is_lossy, first_, count_}, inputs);
}

void PictureSource::require_frames(int frames) const {
  try {
    shown_in(frames - 1);
  } catch (const Error& e) {
    throw named_.placed(e.code(), fmt::format("run.frames {}: {}", frames, e.what()));
  }
}

// A quotient of integers that is an integer is exact, so pictures change at the right frame for rates like 24 and 60.
std::int64_t PictureSource::shown_in(int frame) const {
  if (film_) {
    const std::int64_t frames = film_->frames(std::int64_t{frame} + 1);
    if (frame < frames) return film_->picture_of(frame);
    if (end_ != End::error) return film_->picture_of(end_ == End::hold ? frames - 1 : frame % frames);
    throw Error(ExitCode::usage,
                fmt::format("frame {} comes after '{}', which ends after {} frames (sequence.end \"hold\" or \"loop\" says "
                            "what comes after it)",
                            frame, named_.name, frames));
  }
  if (!is_sequence()) return 0;
  const std::int64_t picture = rate_ > 0 ? static_cast<std::int64_t>(std::floor(frame * rate_ / fps_)) : frame;
  if (picture < count_) return picture;
  if (end_ == End::hold) return count_ - 1;
  if (end_ == End::loop) return picture % count_;
  throw Error(ExitCode::usage, fmt::format("frame {} needs '{}', found {} pictures, the last of them '{}' (sequence.end \"hold\" or "
                                           "\"loop\" says what comes after it)",
                                           frame, file_of(picture), count_, file_of(count_ - 1)));
}

image_io::Picture PictureSource::read(std::int64_t picture, Inputs& inputs) const {
  if (film_) return film_->read(picture);
  image_io::Picture read = read_picture(named_, is_sequence() ? file_of(picture) : named_.name);
  if (!is_sequence()) add_input(named_, read, {named_.key, named_.name, read.decoded_hash.text(), read.lossy}, inputs);
  return read;
}

Error PictureSource::about(const Error& error, std::int64_t picture) const {
  return is_sequence() ? Error(error.code(), fmt::format("{} (in '{}')", error.what(), file_of(picture))) : error;
}

}  // namespace rainref::effect
