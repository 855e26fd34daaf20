// A Radiance picture: a header of lines, the line of its size, and rows of texels of four bytes, three mantissas and their exponent.
// Source: Greg Ward, "The RADIANCE Picture File Format". No library: the one at hand (stb_image) allocates before we could check the size,
// and has other rules for headers than OpenImageIO.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "base/number_text.h"
#include "image_io/direct/formats.h"
#include "image_io/direct/samples.h"

namespace rainref::image_io::direct {
namespace {

constexpr std::size_t texel_bytes = 4;

/// 2^(e - 136), also where it is subnormal.
float scale_of(int e) { return std::bit_cast<float>(e >= 10 ? static_cast<std::uint32_t>(e - 9) << 23 : std::uint32_t{1} << (e + 13)); }

/// Three floats of a texel. Every product is exact.
void put_texel(const std::uint8_t* rgbe, std::size_t step, float* out) {
  const float scale = rgbe[3 * step] ? scale_of(rgbe[3 * step]) : 0.0f;
  for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<float>(rgbe[c * step]) * scale;
}

constexpr std::string_view spaces = " \t";
/// Removes and returns the characters of this set at the beginning of `rest`.
std::string_view take(std::string_view& rest, std::string_view set) {
  const std::string_view out = rest.substr(0, rest.find_first_not_of(set));
  rest.remove_prefix(out.size());
  return out;
}

class HdrReader : public PictureReader {
 public:
  explicit HdrReader(std::span<const std::byte> bytes) : bytes_(bytes) {
    picture_.compression = "none";
    picture_.colour_space = "linear";
    picture_.channels = plain_channels(3, "float", sizeof(float));
    read_header();
    read_size();
    texels_at_ = at_;
  }

  const StoredPicture& picture() const override { return picture_; }

  void read(std::size_t first, std::size_t end, std::byte* texels) override {
    at_ = texels_at_;
    const auto width = static_cast<std::size_t>(picture_.width);
    const std::size_t out_bytes = picture_.texel_bytes(first, end) * width;
    std::vector<std::uint8_t> coded(texel_bytes * width);
    std::vector<float> row(3 * width);
    for (int y = 0; y < picture_.height; ++y, texels += out_bytes) {
      read_row(y, coded, row);
      copy_channels(picture_, first, end, reinterpret_cast<const std::byte*>(row.data()), texels);
    }
  }

 private:
  /// The next line with its end. Lines of any length are read in pieces, so that texels behind a lost header are no line.
  std::string_view line() {
    constexpr std::size_t longest = 128;
    if (at_ >= bytes_.size())
      throw std::runtime_error(fmt::format("RGBE read error -- early end of file at position {}, asked for {}, got 0 bytes, file size {}",
                                           at_, longest, bytes_.size()));
    const std::string_view rest(reinterpret_cast<const char*>(bytes_.data()) + at_, std::min(longest, bytes_.size() - at_));
    const std::string_view out = rest.substr(0, rest.find('\n') == std::string_view::npos ? rest.size() : rest.find('\n') + 1);
    at_ += out.size();
    return out;
  }

  void read_header() {
    constexpr int most_lines = 100;
    line();  // the signature, which the caller has seen
    bool has_format = false;
    std::string_view text = line();
    for (int i = 0; i < most_lines && text[0] != '\n'; ++i, text = line()) {
      has_format = has_format || text == "FORMAT=32-bit_rle_rgbe\n";
      constexpr std::string_view gamma = "GAMMA=";
      if (!text.starts_with(gamma)) continue;
      std::string_view number = text.substr(gamma.size());
      if (const auto value = number_from<float>(take(number, "+-.0123456789eE")))
        picture_.colour_space = gamma_name(1.0 / static_cast<double>(*value));
    }
    if (!has_format) throw std::runtime_error("no FORMAT specifier found");
    if (text != "\n") throw std::runtime_error("missing blank line after FORMAT specifier");
  }

  void read_size() {
    // In the order of EXIF's numbers of orientations.
    constexpr std::string_view axes[] = {"-Y+X", "-Y-X", "+Y-X", "+Y+X", "+X-Y", "+X+Y", "-X+Y", "-X-Y"};
    std::string_view text = line();
    std::string found;
    int sides[2] = {};
    for (int& side : sides) {
      take(text, spaces);
      found += text.substr(0, 2);
      text.remove_prefix(std::min<std::size_t>(2, text.size()));
      take(text, spaces);
      const auto number = whole_from<int>(take(text, "-0123456789"));
      if (!number) throw std::runtime_error("missing image size specifier");
      side = *number;
    }
    const auto* const axis = std::find(std::begin(axes), std::end(axes), found);
    if (axis == std::end(axes)) throw std::runtime_error("missing image size specifier");
    picture_.orientation = static_cast<int>(axis - std::begin(axes)) + 1;
    picture_.height = picture_.full_height = sides[0];
    picture_.width = picture_.full_width = sides[1];
  }

  void copy(int y, std::uint8_t* to, std::size_t count) {
    if (count > bytes_.size() - at_) throw std::runtime_error(fmt::format("Read error on scanline {}", y));
    std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
  }

  /// A row begins with its width if it is coded, channel by channel; rows that are too short or too long never are.
  void read_row(int y, std::vector<std::uint8_t>& coded, std::vector<float>& row) {
    constexpr std::size_t shortest = 8, longest = 0x7fff;
    const std::size_t width = coded.size() / texel_bytes;
    const bool may_be_coded = width >= shortest && width <= longest;
    if (may_be_coded) copy(y, coded.data(), texel_bytes);
    if (may_be_coded && coded[0] == 2 && coded[1] == 2 && coded[2] < 0x80) {
      if ((std::size_t{coded[2]} << 8 | coded[3]) != width)
        throw std::runtime_error(fmt::format("wrong scanline width for scanline {}", y));
      for (std::size_t c = 0; c < texel_bytes; ++c) read_runs(y, std::span(coded).subspan(c * width, width));
      for (std::size_t x = 0; x < width; ++x) put_texel(&coded[x], width, &row[3 * x]);
      return;
    }
    const std::size_t taken = may_be_coded ? texel_bytes : 0;
    if (coded.size() - taken > bytes_.size() - at_) throw std::runtime_error(fmt::format("Read error reading pixels on scanline {}", y));
    copy(y, coded.data() + taken, coded.size() - taken);
    for (std::size_t x = 0; x < width; ++x) put_texel(&coded[texel_bytes * x], 1, &row[3 * x]);
  }

  /// Above 128: so many times the next byte, less 128. Else so many bytes.
  void read_runs(int y, std::span<std::uint8_t> rest) {
    while (!rest.empty()) {
      std::uint8_t head[2];
      copy(y, head, 2);
      const bool is_run = head[0] > 128;
      const std::size_t count = is_run ? head[0] - 128u : head[0];
      if (count == 0 || count > rest.size()) throw std::runtime_error(fmt::format("bad scanline {} data", y));
      std::fill_n(rest.begin(), is_run ? count : 1, head[1]);
      if (!is_run) copy(y, rest.data() + 1, count - 1);
      rest = rest.subspan(count);
    }
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0, texels_at_ = 0;
  StoredPicture picture_;
};

}  // namespace

std::unique_ptr<PictureReader> open_hdr(std::span<const std::byte> bytes) { return std::make_unique<HdrReader>(bytes); }

}  // namespace rainref::image_io::direct
