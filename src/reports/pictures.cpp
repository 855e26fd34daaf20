#include "reports/pictures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "image/code_range.h"
#include "image/colour.h"
#include "image_io/write.h"
#include "judge/quantities.h"
#include "judge/slots.h"
#include "math/real64.h"
#include "reports/figures.h"

namespace rainref::reports {
namespace {

using capture::Array;
using judge::is_nan;
using judge::OutputJudgement;

struct Rgb {
  std::uint8_t r, g, b;
};
constexpr Rgb nan_colour{255, 0, 255};
constexpr std::array<Rgb, 5> verdict_colours{{{0x20, 0x26, 0x2d}, {0x2f, 0x7f, 0xc1}, {0xf2, 0xb1, 0x34}, {0xff, 0x2d, 0x6f}, {0, 0, 0}}};

std::string hex(Rgb c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

Rgb between(Rgb a, Rgb b, double t) {
  const auto mix = [&](std::uint8_t from, std::uint8_t to) { return static_cast<std::uint8_t>(from + (to - from) * t + 0.5); };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}
/// Dark without a difference, so that a single texel is visible.
Rgb difference_rgb(std::int64_t codes, std::uint64_t largest) {
  if (codes == 0 || largest == 0) return {0x14, 0x18, 0x1d};
  const auto size = static_cast<std::uint64_t>(codes < 0 ? -codes : codes);
  const double t = std::bit_width(largest) <= 1 ? 1 : static_cast<double>(std::bit_width(size) - 1) / (std::bit_width(largest) - 1);
  return codes < 0 ? between({0x1d, 0x4e, 0x9e}, {0x9f, 0xe8, 0xff}, t) : between({0xa3, 0x3f, 0x0c}, {0xff, 0xf0, 0xa8}, t);
}

/// Values of an array's first level.
class Texels {
 public:
  explicit Texels(const Array& a) : array_(a), format_(info(a.format)) {}
  const std::byte* at(int x, int y, int channel) const {
    const std::size_t texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(array_.width) + static_cast<std::size_t>(x);
    return array_.levels[0].data() + texel * static_cast<std::size_t>(format_.texel_bytes()) +
           static_cast<std::size_t>(channel * format_.channel_bytes);
  }
  std::int64_t code(int x, int y, int channel) const { return enclosed::ordered_code(format_.kind, at(x, y, channel)); }
  bool nan(int x, int y, int channel) const { return is_nan(format_.kind, at(x, y, channel)); }
  double value(int x, int y, int channel) const { return enclosed::code_value(format_.kind, code(x, y, channel)); }
  /// The stored integer of an 8-bit format.
  std::uint8_t byte(int x, int y, int channel) const { return std::to_integer<std::uint8_t>(*at(x, y, channel)); }

 private:
  const Array& array_;
  const FormatInfo& format_;
};

/// The channels that a view shows, and the mapping of their values to grey levels or colours.
struct Display {
  std::string label, scale;
  std::vector<int> channels;  ///< one, or three for colour
  std::function<std::uint8_t(const Texels&, int x, int y, int channel)> level;
};

std::uint8_t eight_bits(double x) { return !(x > 0) ? 0 : x >= 1 ? 255 : static_cast<std::uint8_t>(255 * x + 0.5); }

/// Quantiles of a channel's finite values; 0 if none is finite.
std::vector<double> quantiles(const Texels& t, const Array& a, int channel, std::initializer_list<double> shares) {
  std::vector<double> values;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double v = t.value(x, y, channel);
      if (std::abs(v) <= std::numeric_limits<float>::max()) values.push_back(v);
    }
  }
  std::vector<double> out;
  std::sort(values.begin(), values.end());
  for (const double share : shares)
    out.push_back(values.empty() ? 0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))]);
  return out;
}

Display colour_display(const Array& expected) {
  const FormatInfo::Kind kind = info(expected.format).kind;
  if (kind == FormatInfo::unorm8 || kind == FormatInfo::srgb8)
    return {"colour", "codes as stored", {0, 1, 2}, [](const Texels& t, int x, int y, int c) { return t.byte(x, y, c); }};
  double brightest = 0;
  for (int c = 0; c < 3; ++c) brightest = std::max(brightest, quantiles(Texels(expected), expected, c, {0.99})[0]);
  int stops = 0;
  double factor = 1;
  for (; brightest * factor > 1 && stops > -32; --stops) factor /= 2;
  for (; brightest > 0 && brightest * factor <= 0.25 && stops < 32; ++stops) factor *= 2;
  return {"colour", fmt::format("exposure {:+d} stops, sRGB-encoded", stops), {0, 1, 2}, [factor](const Texels& t, int x, int y, int c) {
            const double v = t.value(x, y, c) * factor;
            return v >= 1 ? std::uint8_t{255} : v > 0 ? eight_bits(encode_srgb(v)) : std::uint8_t{0};
          }};
}

Display channel_display(const Array& expected, int channel, const std::string& label, const std::string& unit) {
  const std::vector<double> ends = quantiles(Texels(expected), expected, channel, {0.01, 0.99});
  double low = ends[0], high = ends[1];
  const std::string of = unit.empty() || unit == "1" ? "" : " " + unit;
  std::string scale = fmt::format("black {:.4g}, white {:.4g}{}", low, high, of);
  if (!(low < high)) {
    scale = fmt::format("grey {:.4g}{}: the reference is constant", low, of);
    const double half = low == 0 ? 1 : std::abs(low);
    low -= half;
    high = low + 2 * half;
  }
  return {label, scale, {channel}, [low, high](const Texels& t, int x, int y, int c) {
            return eight_bits((t.value(x, y, c) - low) / (high - low));
          }};
}

std::vector<Display> displays_of(const capture::CaseOutput& output, const Array& port) {
  const Array& expected = output.array;
  const int channels = info(expected.format).channels;
  std::vector<Display> out;
  const bool colour = channels >= 3 && !output.color_space.empty() && output.color_space != "none";
  if (!colour) {
    for (int c = 0; c < channels; ++c) out.push_back(channel_display(expected, c, channel_name(c), judge::unit_of(output.unit, c)));
    return out;
  }
  out.push_back(colour_display(expected));
  // Alpha is mostly 1 everywhere, so it is shown only if it is not.
  const Texels a(expected), b(port);
  for (int y = 0; channels == 4 && y < expected.height; ++y) {
    for (int x = 0; x < expected.width; ++x) {
      if (a.code(x, y, 3) == a.code(0, 0, 3) && a.code(x, y, 3) == b.code(x, y, 3)) continue;
      out.push_back(channel_display(expected, 3, "alpha", ""));
      return out;
    }
  }
  return out;
}

/// The largest difference among the shown channels; nothing if one is NaN.
std::optional<std::int64_t> difference(const Texels& expected, const Texels& port, const std::vector<int>& channels, int x, int y) {
  std::int64_t most = 0;
  for (const int c : channels) {
    if (expected.nan(x, y, c) || port.nan(x, y, c)) return std::nullopt;
    const std::int64_t d = port.code(x, y, c) - expected.code(x, y, c);
    if (std::abs(d) > std::abs(most)) most = d;
  }
  return most;
}

void set(Image& image, int x, int row, Rgb c) {
  std::uint8_t* texel = image.row<std::uint8_t>(image.height() - 1 - row) + 4 * x;
  texel[0] = c.r;
  texel[1] = c.g;
  texel[2] = c.b;
  texel[3] = 255;
}

/// One view of the texels from (x0, y0) on.
View view_of(const Display& d, const OutputJudgement& o, const Array& expected, const Array& port, View v, std::uint64_t largest) {
  v.scale = d.scale;
  v.largest = largest;
  const Texels a(expected), b(port);
  const int columns = (v.width + v.thinned - 1) / v.thinned, rows = (v.height + v.thinned - 1) / v.thinned;
  Image reference(Format::rgba8, columns, rows), got(Format::rgba8, columns, rows), differs(Format::rgba8, columns, rows),
      verdict(Format::rgba8, columns, rows);
  const auto shown = [&](const Texels& t, int x, int y) {
    for (const int c : d.channels) {
      if (!t.nan(x, y, c)) continue;
      v.has_nan = true;
      return nan_colour;
    }
    const auto level = [&](std::size_t k) { return d.level(t, x, y, d.channels[k]); };
    if (d.channels.size() == 3) return Rgb{level(0), level(1), level(2)};
    return Rgb{level(0), level(0), level(0)};
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int x = v.x0 + column * v.thinned, y = v.y0 + row * v.thinned;
      set(reference, column, row, shown(a, x, y));
      set(got, column, row, shown(b, x, y));
      std::int64_t most = 0;
      bool nan = false;
      std::uint8_t worst = OutputJudgement::not_judged;
      for (int j = y; j < std::min(y + v.thinned, v.y0 + v.height); ++j) {
        for (int i = x; i < std::min(x + v.thinned, v.x0 + v.width); ++i) {
          const std::optional<std::int64_t> difference_here = difference(a, b, d.channels, i, j);
          nan |= !difference_here;
          if (difference_here && std::abs(*difference_here) > std::abs(most)) most = *difference_here;
          const std::uint8_t one = o.map[static_cast<std::size_t>(j) * static_cast<std::size_t>(o.width) + static_cast<std::size_t>(i)];
          if (one != OutputJudgement::not_judged) worst = worst == OutputJudgement::not_judged ? one : std::max(worst, one);
        }
      }
      set(differs, column, row, nan ? nan_colour : difference_rgb(most, largest));
      set(verdict, column, row, verdict_colours.at(worst));
    }
  }
  v.reference = image_io::png_bytes(reference);
  v.port = image_io::png_bytes(got);
  v.difference = image_io::png_bytes(differs);
  v.verdict = image_io::png_bytes(verdict);
  return v;
}

std::uint64_t largest_difference(const Display& d, const Array& expected, const Array& port) {
  const Texels a(expected), b(port);
  std::uint64_t largest = 0;
  for (int y = 0; y < expected.height; ++y)
    for (int x = 0; x < expected.width; ++x)
      largest = std::max(largest, static_cast<std::uint64_t>(std::abs(difference(a, b, d.channels, x, y).value_or(0))));
  return largest;
}

}  // namespace

std::string verdict_colour(int verdict) { return hex(verdict_colours.at(static_cast<std::size_t>(verdict))); }
std::string difference_colour(std::int64_t codes, std::uint64_t largest) { return hex(difference_rgb(codes, largest)); }

std::vector<View> views_of(const OutputJudgement& o, const capture::CaseOutput& output, const Array& port) {
  const Array& expected = output.array;
  std::vector<View> views;
  if (o.records || o.map.empty()) return views;
  const int thinned = (std::max(o.width, o.height) + picture_side - 1) / picture_side;
  for (const Display& d : displays_of(output, port)) {
    const std::uint64_t largest = largest_difference(d, expected, port);
    View whole;
    whole.label = d.label;
    whole.width = o.width;
    whole.height = o.height;
    whole.thinned = thinned;
    views.push_back(view_of(d, o, expected, port, whole, largest));
    if (thinned == 1 || o.worst.empty()) continue;
    View window;
    window.label = d.label + ", window";
    window.width = std::min(picture_window, o.width);
    window.height = std::min(picture_window, o.height);
    window.x0 = std::clamp(o.worst[0].x - window.width / 2, 0, o.width - window.width);
    window.y0 = std::clamp(o.worst[0].y - window.height / 2, 0, o.height - window.height);
    views.push_back(view_of(d, o, expected, port, window, largest));
  }
  return views;
}

}  // namespace rainref::reports
