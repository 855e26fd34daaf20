#include "effect/film_reader.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number_text.h"
#include "base/path_text.h"
#include "base/piped_program.h"
#include "base/program_path.h"
#include "base/hash_of_file.h"

namespace rainref::effect {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{8} << 30;
constexpr int most_seconds = 3600;

struct Kind {
  const char *ending, *demuxer;
};
constexpr Kind kinds[] = {{".mp4", "mov"}, {".m4v", "mov"}, {".mov", "mov"}, {".webm", "matroska"}, {".mkv", "matroska"}};

const Kind* kind_of(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const auto found = std::ranges::find_if(kinds, [&](const Kind& k) { return lower.ends_with(k.ending); });
  return found == std::end(kinds) ? nullptr : found;
}

/// ffmpeg with a pipe from it. What fails is an Error with the key and the film.
class Ffmpeg {
 public:
  /// `filters`: after those that place the film's pictures in the frames of the run.
  Ffmpeg(const NamedFile& named, double fps, const std::string& filters, const std::vector<std::string>& output) : named_(named) {
    if (!starts_programs())
      throw named.placed(ExitCode::io, fmt::format("'{}': films need ffmpeg, which no web page can start", named.name));
    const std::filesystem::path program = program_in_path("ffmpeg");
    if (program.empty()) {
      throw named.placed(ExitCode::io, fmt::format("'{}': ffmpeg, which reads films, is in no folder of PATH (Debian: apt-get install "
                                                   "ffmpeg)",
                                                   named.name));
    }
    // Times in Matroska are whole milliseconds, so a picture may come 0.7 ms before its time.
    const std::string placed = fmt::format("settb=AVTB,setpts=PTS-STARTPTS-700,fps={}:round=up{}", fps, filters);
    std::vector<std::string> words{"-nostdin",
                                   "-hide_banner",
                                   "-v",
                                   "error",
                                   "-timelimit",
                                   std::to_string(most_seconds),
                                   "-protocol_whitelist",
                                   "file",
                                   "-f",
                                   kind_of(named.name)->demuxer,
                                   "-i",
                                   "file:" + system_path_text(named.path_of(named.name)),
                                   "-map",
                                   "0:v:0",
                                   "-vf",
                                   placed};
    words.insert(words.end(), output.begin(), output.end());
    try {
      program_ = std::make_unique<PipedProgram>(program, words, PipedProgram::Pipe::from_output);
    } catch (const std::runtime_error& e) {
      throw named.placed(ExitCode::io, fmt::format("'{}': {}", named.name, e.what()));
    }
  }
  /// Reads at most so many bytes.
  std::size_t read(std::span<std::byte> bytes) {
    try {
      return program_->read(bytes);
    } catch (const std::system_error& e) {
      throw named_.placed(ExitCode::io, fmt::format("'{}': ffmpeg's output cannot be read: {}", named_.name, e.code().message()));
    }
  }
  /// Waits for it. Throws Error(code) if it failed, or if its output ended too early.
  void end(ExitCode code, bool is_early) {
    const CommandEnd ended = program_->end("ffmpeg");
    const std::string failure = ended.failure.empty() && is_early ? "ffmpeg gave no picture" : ended.failure;
    if (failure.empty()) return;
    throw named_.placed(code, ended.last_lines.empty()
                                  ? fmt::format("'{}': {}", named_.name, failure)
                                  : fmt::format("'{}': {}; it printed: {}", named_.name, failure, fmt::join(ended.last_lines, " | ")));
  }

 private:
  const NamedFile& named_;
  std::unique_ptr<PipedProgram> program_;
};

}  // namespace

bool is_film(const std::string& name) { return kind_of(name) != nullptr; }

/// The film's pictures from one frame on, as raw texels.
class FilmReader::Decoder {
 public:
  Decoder(const NamedFile& named, double fps, Size size, std::int64_t first)
      : named_(named),
        next_(first),
        rgb_(3 * static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])),
        ffmpeg_(named, fps,
                fmt::format(",trim=start_frame={},setpts=PTS-STARTPTS,scale=flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format="
                            "rgb24",
                            first),
                {"-f", "rawvideo", "-"}) {}
  /// Whether the next pictures, or the last one that was read, are soon this one.
  bool comes_to(std::int64_t picture) const { return picture >= next_ - 1 && picture < next_ + 100; }
  /// Texels, top row first.
  const std::vector<std::byte>& read(std::int64_t picture) {
    for (; next_ <= picture; ++next_)
      if (ffmpeg_.read(rgb_) != rgb_.size()) ffmpeg_.end(ExitCode::io, true);
    return rgb_;
  }

 private:
  const NamedFile& named_;
  std::int64_t next_;
  std::vector<std::byte> rgb_;
  Ffmpeg ffmpeg_;
};

FilmReader::FilmReader(const NamedFile& named, double fps, std::int64_t frames) : named_(named), fps_(fps) {
  try {
    hash_ = hash_of_file(named.path_of(named.name), {most_bytes, ExitCode::usage}).text();
  } catch (const Error& e) {
    throw named.placed(e.code(), e.what());
  }
  look_at(frames);
}
FilmReader::~FilmReader() = default;

// ffmpeg prints the size, "#dimensions 0: 320x180", and a line for each frame, which ends with the hash of its texels.
void FilmReader::look_at(std::int64_t frames) {
  Ffmpeg ffmpeg(named_, fps_, "", {"-frames:v", std::to_string(frames), "-f", "framemd5", "-"});
  std::string text;
  std::array<char, 65536> some;
  while (const std::size_t count = ffmpeg.read(std::as_writable_bytes(std::span(some)))) text.append(some.data(), count);
  pictures_.clear();
  std::string_view rest = text, before;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.starts_with("#dimensions 0: ")) {
      const std::string_view size = line.substr(15);
      const std::size_t x = size.find('x');
      size_ = {whole_from<int>(size.substr(0, x)).value_or(0), whole_from<int>(size.substr(std::min(x + 1, size.size()))).value_or(0)};
    }
    if (line.starts_with('#')) continue;
    const std::string_view picture = line.substr(line.rfind(',') + 1);
    pictures_.push_back(!pictures_.empty() && picture == before ? pictures_.back() : static_cast<std::int64_t>(pictures_.size()));
    before = picture;
  }
  ffmpeg.end(ExitCode::usage, pictures_.empty() || size_[0] < 1 || size_[1] < 1);
  has_ended_ = static_cast<std::int64_t>(pictures_.size()) < frames;
}

std::int64_t FilmReader::frames(std::int64_t wanted) {
  const auto known = static_cast<std::int64_t>(pictures_.size());
  if (wanted > known && !has_ended_) look_at(std::max(wanted, 2 * known));
  return static_cast<std::int64_t>(pictures_.size());
}

image_io::Picture FilmReader::read(std::int64_t picture) {
  std::unique_ptr<Decoder> decoder = std::move(decoder_);  // not kept after a failure
  if (!decoder || !decoder->comes_to(picture)) {
    decoder.reset();
    decoder = std::make_unique<Decoder>(named_, fps_, size_, picture);
  }
  const std::vector<std::byte>& rgb = decoder->read(picture);
  image_io::Picture out;
  out.image = Image(Format::rgba8, size_[0], size_[1]);
  const std::byte* in = rgb.data();
  for (int y = 0; y < size_[1]; ++y) {
    std::byte* to = out.image.row_bytes(y);
    for (int x = 0; x < size_[0]; ++x, in += 3, to += 4) {
      std::copy_n(in, 3, to);
      to[3] = std::byte{255};
    }
  }
  out.channel_names = {"R", "G", "B"};
  out.srgb_encoded = out.lossy = true;
  out.file_width = size_[0];
  out.file_height = size_[1];
  decoder_ = std::move(decoder);
  return out;
}

}  // namespace rainref::effect
