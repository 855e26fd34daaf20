#include "image/footprint.h"

#include <algorithm>

#include "math/floor_of.h"

namespace rainref::enclosed {
namespace {

double unit_roundoff() { return profile().basic == BasicRounding::nearest ? 0x1p-24 : 0x1p-23; }

double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52); }

std::int64_t cell_of(double x) { return static_cast<std::int64_t>(floor_of(x)); }

// 1 - |2 fract(u / 2) - 1| over [lo, hi]: 0 at even and 1 at odd numbers, straight between.
Enclosure mirrored(Enclosure u) {
  const auto wave = [](double x) {
    const double phase = x - 2 * floor_of(x / 2);
    return phase <= 1 ? phase : 2 - phase;
  };
  const double a = wave(u.lo), b = wave(u.hi);
  const bool even = floor_of(u.hi / 2.0) > floor_of(u.lo / 2.0) || wave(u.lo) == 0;
  const bool odd = floor_of((u.hi + 1.0) / 2) > floor_of((u.lo + 1.0) / 2) || a == 1;
  return {float_below(even ? 0 : std::min(a, b)), float_above(odd ? 1 : std::max(a, b))};
}

// a(u) size - shift.
Span span(Address address, Enclosure u, int size, float shift) {
  if (u.is_vacuous()) return {0, 0, size, address, true};
  const Profile& p = profile();
  const Enclosure side(static_cast<float>(size));
  const Enclosure x = (address == Address::mirror ? mirrored(u) : u) * side - Enclosure(shift);
  if (x.is_vacuous()) return {0, 0, size, address, true};
  // Error of reducing u first: the roundings of fract, of the mirror's subtractions, of the product and of the shift.
  double slack = 0;
  if (address == Address::repeat) slack = 2.5 * unit_roundoff() * size;
  if (address == Address::mirror) slack = 5 * unit_roundoff() * size;
  if (p.subtexel_bits > 0) slack += power_of_two(-p.subtexel_bits);
  if (p.coordinate_bits > 0) slack += power_of_two(-p.coordinate_bits) * u.magnitude() * size;
  return {x.lo - slack, x.hi + slack, size, address, false};
}

Span held(Span s, double low, double high) {
  s.lo = std::clamp(s.lo, low, high);
  s.hi = std::clamp(s.hi, low, high);
  return s;
}

float texel_of(const Texels& t, int column, int row, int channel) {
  if (column < 0 || row < 0) return t.border[channel];
  return t.texels[(static_cast<std::int64_t>(row) * t.width + column) * t.channels + channel];
}

// The hull of texels [x0, x1] x [y0, y1] by the address rules.
Enclosure texel_hull(const Texels& t, const Span& x, const Span& y, std::int64_t x0, std::int64_t x1, std::int64_t y0, std::int64_t y1,
                     int channel) {
  // One period of indices covers every texel; the other rules have only a few indices outside.
  if (x.address == Address::repeat) x1 = std::min(x1, x0 + x.size - 1);
  if (y.address == Address::repeat) y1 = std::min(y1, y0 + y.size - 1);
  if ((x1 - x0 + 1) * (y1 - y0 + 1) > most_texels) return Enclosure::vacuous();
  Enclosure out(infinity, -infinity);
  for (std::int64_t j = y0; j <= y1; ++j) {
    for (std::int64_t i = x0; i <= x1; ++i) {
      const float v = texel_of(t, x.index(i), y.index(j), channel);
      out = hull(out, {v, v});
    }
  }
  return out;
}

double magnitude(double x) { return x < 0 ? -x : x; }

// Largest change of a cell's value due to rounding its four weights. Rows and columns keep their sums, so the error of one weight enters
// the others with alternating signs. An H100 rounds by half a step; twice that is allowed.
double weight_slack(double a, double b, double c, double d) { return power_of_two(-profile().subtexel_bits) * magnitude(a - b - c + d); }
// The same if the weights include the level's share. With s the share, X = s f_x + e and the weights X f_y + e' and (s - X) f_y + e'' of
// the second row, the error of the value is e ((b - a)(1 - f_y) + (d - c) f_y) + e' (d - b) + e'' (c - a).
double joint_slack(double a, double b, double c, double d) {
  const double right = magnitude(b - a), right_above = magnitude(d - c), up = magnitude(c - a), up_beside = magnitude(d - b);
  const double x_first = std::max(right, right_above) + up + up_beside, y_first = std::max(up, up_beside) + right + right_above;
  return 0.5 * power_of_two(-profile().subtexel_bits) * std::max(x_first, y_first);
}
// One step of the texels' own precision at this magnitude.
double storage_step(TexelPrecision precision, double magnitude) {
  if (precision == TexelPrecision::unorm8) return 1.0 / 255;
  if (precision == TexelPrecision::float32) return 0;
  const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(magnitude) >> 52) - 1023;
  return power_of_two(std::max(exponent - 10, -24));
}

}  // namespace

int Span::index(std::int64_t i) const {
  if (i >= 0 && i < size) return static_cast<int>(i);
  if (address == Address::repeat) return static_cast<int>(((i % size) + size) % size);
  if (address == Address::border) return -1;
  return static_cast<int>(std::clamp<std::int64_t>(i, 0, size - 1));
}

Span filtered_span(Address address, Enclosure u, int size) {
  const Span s = span(address, u, size, 0.5f);
  if (address == Address::repeat) return s;
  return address == Address::border ? held(s, -1, size) : held(s, 0, size - 1);
}
Span nearest_span(Address address, Enclosure u, int size) {
  const Span s = span(address, u, size, 0);
  return address == Address::repeat ? s : held(s, -1, size);
}

Enclosure filtered(const Texels& t, const Span& x, const Span& y, int channel) {
  JointRounding unused;
  return filtered(t, x, y, channel, unused);
}
Enclosure filtered(const Texels& t, const Span& x, const Span& y, int channel, JointRounding& joint) {
  if (x.vacuous || y.vacuous) return Enclosure::vacuous();
  // Coordinates so large that their integers are meaningless.
  if (std::max(std::max(-x.lo, x.hi), std::max(-y.lo, y.hi)) > 0x1p40) return Enclosure::vacuous();
  const std::int64_t x0 = cell_of(x.lo), x1 = cell_of(x.hi), y0 = cell_of(y.lo), y1 = cell_of(y.hi);
  double low = infinity, high = -infinity, least = infinity, greatest = -infinity, slack = 0;
  const bool sampler = profile().subtexel_bits > 0;
  if ((x1 - x0 + 1) * (y1 - y0 + 1) > 16) {
    const Enclosure all = texel_hull(t, x, y, x0, x1 + 1, y0, y1 + 1, channel);
    if (all.is_vacuous()) return all;
    low = least = all.lo;
    high = greatest = all.hi;
  } else {
    for (std::int64_t j = y0; j <= y1; ++j) {
      // A texel of weight 0 adds nothing by either formula.
      const int row = y.index(j), next_row = y.hi > j ? y.index(j + 1) : row;
      const double below = std::max(y.lo - j, 0.0), above = std::min(y.hi - j, 1.0);
      for (std::int64_t i = x0; i <= x1; ++i) {
        const int column = x.index(i), next_column = x.hi > i ? x.index(i + 1) : column;
        const double a = texel_of(t, column, row, channel), b = texel_of(t, next_column, row, channel);
        const double c = texel_of(t, column, next_row, channel), d = texel_of(t, next_column, next_row, channel);
        least = std::min(least, std::min(std::min(a, b), std::min(c, d)));
        greatest = std::max(greatest, std::max(std::max(a, b), std::max(c, d)));
        if (sampler) {
          slack = std::max(slack, weight_slack(a, b, c, d));
          joint.slack = std::max(joint.slack, joint_slack(a, b, c, d));
        }
        // Linear in each weight: the extrema are at the corners.
        const auto at = [&](double f) {
          const double bottom = a * (1 - f) + b * f, top = c * (1 - f) + d * f;
          const double first = bottom * (1 - below) + top * below, last = bottom * (1 - above) + top * above;
          low = std::min(low, std::min(first, last));
          high = std::max(high, std::max(first, last));
        };
        at(std::max(x.lo - i, 0.0));
        at(std::min(x.hi - i, 1.0));
      }
    }
  }
  joint.precision = t.precision;
  joint.least = least;
  joint.greatest = greatest;
  const double size = std::max(-least, greatest), gap = greatest - least;
  if (size == 0) return {0.0f, 0.0f};
  if (sampler) {
    // At the value's own magnitude, which may be far below that of a neighbouring texel.
    slack += storage_step(t.precision, std::max(slack - low, high + slack));
    joint.below = low - std::max(low - slack, least);
    joint.above = std::min(high + slack, greatest) - high;
    low -= joint.below;
    high += joint.above;
  }
  // Two mixes in sequence, each with three roundings of a (1 - t) + b t or of a + (b - a) t, and the rounding of the two weights x -
  // floor(x), which is zero except below 0.
  const double flushed = profile().flush == Flush::never ? 0x1p-147 : 0x1p-123;
  const double error = unit_roundoff() * (2 * (size + 2 * std::max(size, gap)) + 2 * gap) * (1 + 0x1p-10) + flushed;
  Enclosure out(float_below(low - error), float_above(high + error));
  if (least >= 0) out.lo = std::max(out.lo, 0.0f);
  if (greatest <= 0) out.hi = std::min(out.hi, 0.0f);
  return Enclosure::checked(out.lo, out.hi);
}

Enclosure between_levels(Enclosure fine, const JointRounding& fine_rounding, Enclosure coarse, const JointRounding& coarse_rounding,
                         float low, float high) {
  const Enclosure out = mix(fine, coarse, Enclosure(low, high));
  if (out.is_vacuous() || profile().subtexel_bits == 0) return out;
  const double fine_most = 1.0 - static_cast<double>(low), fine_least = 1.0 - static_cast<double>(high), coarse_most = high,
               coarse_least = low;
  // A level adds at most its share of the error; the error already in its own hull counts toward that.
  const auto of_level = [](const JointRounding& r, double most_share) { return std::min(r.slack, most_share * (r.greatest - r.least)); };
  const double weights = of_level(fine_rounding, fine_most) + of_level(coarse_rounding, coarse_most);
  const double slack = weights + storage_step(fine_rounding.precision, std::max(weights - out.lo, out.hi + weights));
  const double below = slack - fine_least * fine_rounding.below - coarse_least * coarse_rounding.below;
  const double above = slack - fine_least * fine_rounding.above - coarse_least * coarse_rounding.above;
  // The weights are not negative and sum to 1, so values outside the range of all texels are possible only by the roundings of the mix.
  const double least = std::min(fine_rounding.least, coarse_rounding.least),
               greatest = std::max(fine_rounding.greatest, coarse_rounding.greatest);
  return Enclosure::checked(std::min(out.lo, float_below(std::max(out.lo - below, least))),
                            std::max(out.hi, float_above(std::min(out.hi + above, greatest))));
}

Pick pick(const Span& x, const Span& y) {
  if (x.vacuous || y.vacuous || std::max({-x.lo, x.hi, -y.lo, y.hi}) > 0x1p40) return {0, 0, 0, 0, true};
  const auto candidates = [](const Span& s, std::int64_t& first, std::int64_t& last) {
    first = cell_of(s.lo);
    last = cell_of(s.hi);
    if (s.address == Address::clamp || s.address == Address::mirror) {
      first = std::clamp<std::int64_t>(first, 0, s.size - 1);
      last = std::clamp<std::int64_t>(last, 0, s.size - 1);
    }
  };
  Pick p{0, 0, 0, 0, false};
  candidates(x, p.x0, p.x1);
  candidates(y, p.y0, p.y1);
  const std::int64_t columns = p.x1 - p.x0 + 1, rows = p.y1 - p.y0 + 1;
  if (columns * rows > PathEnumeration::max_runs) return p;
  if (columns > 1) p.x0 += choose(static_cast<int>(columns));
  if (rows > 1) p.y0 += choose(static_cast<int>(rows));
  p.x1 = p.x0;
  p.y1 = p.y0;
  return p;
}
Enclosure picked(const Texels& t, const Span& x, const Span& y, const Pick& p, int channel) {
  if (p.vacuous) return Enclosure::vacuous();
  const Enclosure out = texel_hull(t, x, y, p.x0, p.x1, p.y0, p.y1, channel);
  return Enclosure::checked(out.lo, out.hi);
}

Enclosure level_range(Enclosure lod, int levels) {
  const double last = levels - 1;
  if (lod.is_vacuous()) return {0.0f, static_cast<float>(last)};
  double slack = 0;
  if (const int bits = profile().lod_bits; bits > 0) {
    // A level that fixed point represents exactly is used unchanged.
    const double scaled = lod.lo * power_of_two(bits);
    if (!lod.is_point() || floor_of(scaled) != scaled) slack = power_of_two(-bits);
  }
  return {float_below(std::clamp(lod.lo - slack, 0.0, last)), float_above(std::clamp(lod.hi + slack, 0.0, last))};
}

}  // namespace rainref::enclosed
