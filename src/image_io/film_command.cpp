#include "image_io/film_command.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/path_text.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

namespace fs = std::filesystem;

struct FilmFormat {
  std::string_view suffix;
  const char* muxer;
  const char* filter;
  std::vector<std::string> encoder;
  double most_per_second;  ///< 0: no limit
};

// YUV with half the colour resolution needs even sides: an odd picture gets a black line. The pictures are sRGB; the matrix is BT.709's,
// which players assume for films of this size, and the file says so.
constexpr const char* to_yuv =
    "pad=ceil(iw/2)*2:ceil(ih/2)*2,"
    "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=yuv420p";
std::vector<std::string> with_colours(std::vector<std::string> encoder) {
  for (const char* word : {"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv"})
    encoder.emplace_back(word);
  return encoder;
}

const std::array<FilmFormat, 3>& formats() {
  static const std::array<FilmFormat, 3> all{{
      // Rain at night is small bright details on dark: 18 keeps them; the default of 23 blurs them.
      {".mp4", "mp4", to_yuv, with_colours({"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-movflags", "+faststart"}), 0},
      {".webm", "webm", to_yuv, with_colours({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "good", "-cpu-used", "4"}), 0},
      // One palette for the whole film, so that static parts do not flicker; ffmpeg holds all pictures until the palette is known. Not from
      // moving parts only (stats_mode=diff): that omits the last picture's colours. Times are in hundredths of a second, and browsers show
      // 1 as 10.
      {".gif",
       "gif",
       "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle",
       {"-c:v", "gif", "-loop", "0"},
       50},
  }};
  return all;
}

const FilmFormat& format_of(const fs::path& film, FilmRate rate) {
  std::string suffix = path_text(film.extension());
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c; });
  for (const FilmFormat& f : formats()) {
    if (suffix != f.suffix) continue;
    if (f.most_per_second > 0 && rate.per_second() > f.most_per_second)
      throw Error(ExitCode::usage,
                  fmt::format("film '{}': expected at most {:g} pictures a second, which is what a GIF can show, found {:g}: --every {} "
                              "gives fewer",
                              path_text(film), f.most_per_second, rate.per_second(), 2 * rate.every));
    return f;
  }
  throw Error(ExitCode::usage, fmt::format("film '{}': expected a name that ends in .mp4, .webm or .gif", path_text(film)));
}

}  // namespace

std::vector<std::string> film_arguments(const fs::path& film, int width, int height, FilmRate rate, const fs::path& output) {
  const FilmFormat& f = format_of(film, rate);
  std::vector<std::string> all{"-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size"};
  const auto add = [&](std::vector<std::string> more) { all.insert(all.end(), more.begin(), more.end()); };
  add({fmt::format("{}x{}", width, height), "-framerate", fmt::format("{}/{}", rate.fps, rate.every), "-i", "pipe:0"});
  add({"-vf", f.filter, "-an", "-threads", "1", "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
  add(f.encoder);
  // "file:", because a name may begin with a dash or contain a colon.
  add({"-f", f.muxer, "file:" + system_path_text(output)});
  return all;
}

}  // namespace rainref::image_io
