#include "night_street/tubes.h"

#include "night_street/city.h"

namespace rainref::night_street {

namespace {

/// Strokes of a letter on a grid 4 wide and 6 tall: "x0 y0 x1 y1" in one digit each, strokes separated by a space.
std::string_view strokes(char letter) {
  switch (letter) {
    case 'A':
      return "0004 0426 2644 4440 0343";
    case 'B':
      return "0006 0636 3645 4544 4433 0333 3342 4241 4130 3000";
    case 'C':
      return "4536 3616 1605 0501 0110 1030 3041";
    case 'D':
      return "0006 0626 2644 4442 4220 2000";
    case 'E':
      return "0006 0646 0333 0040";
    case 'F':
      return "0006 0646 0333";
    case 'G':
      return "4536 3616 1605 0501 0110 1030 3041 4143 4323";
    case 'H':
      return "0006 4046 0343";
    case 'I':
      return "2026 1636 1030";
    case 'K':
      return "0006 0246 1340";
    case 'L':
      return "0006 0040";
    case 'M':
      return "0006 0623 2346 4640";
    case 'N':
      return "0006 0640 4046";
    case 'O':
      return "1030 3041 4145 4536 3616 1605 0501 0110";
    case 'P':
      return "0006 0636 3645 4544 4433 3303";
    case 'R':
      return "0006 0636 3645 4544 4433 3303 2340";
    case 'S':
      return "4536 3616 1605 0504 0413 1333 3342 4241 4130 3010 1001";
    case 'T':
      return "0646 2620";
    case 'U':
      return "0601 0110 1030 3041 4146";
    case 'V':
      return "0620 2046";
    case 'W':
      return "0610 1023 2330 3046";
    case 'X':
      return "0046 0640";
    case 'Y':
      return "0623 2346 2320";
    case 'Z':
      return "0646 4600 0040";
    default:
      return "";
  }
}

/// Squared distance from (x, y) to the segment a-b.
double squared_distance(double x, double y, double ax, double ay, double bx, double by) {
  const double dx = bx - ax, dy = by - ay, px = x - ax, py = y - ay;
  const double along = clamp01((px * dx + py * dy) / (dx * dx + dy * dy));
  return square(px - along * dx) + square(py - along * dy);
}

/// Squared distance, letter units, to the nearest stroke of a letter whose lower left corner is (0, 0).
double distance_to_letter(char letter, double x, double y) {
  const std::string_view code = strokes(letter);
  double nearest = 100;
  for (std::size_t i = 0; i + 4 <= code.size(); i += 5) {
    nearest = min_of(nearest, squared_distance(x, y, code[i] - '0', code[i + 1] - '0', code[i + 2] - '0', code[i + 3] - '0'));
  }
  return nearest;
}

}  // namespace

Vec tube_radiance(const Sign& sign, double width, double height, double u, double v, double soft) {
  const auto letters = static_cast<std::int64_t>(sign.text.size());
  const double x = u / sign.unit, y = v / sign.unit, board_x = width / sign.unit, board_y = height / sign.unit;
  double squared = 100;
  if (sign.upright) {
    const double pitch = 8, top = board_y - 2;  // 2 units of margin, letters downwards
    const std::int64_t i = floor_int((top + 1 - y) / pitch);
    if (i >= 0 && i < letters) {
      const double foot = top - 6 - pitch * static_cast<double>(i);
      squared = distance_to_letter(sign.text[static_cast<std::size_t>(i)], x - 0.5 * (board_x - 4), y - foot);
    }
  } else {
    const double pitch = 6, left = 0.5 * (board_x - (pitch * static_cast<double>(letters) - 2));
    const std::int64_t i = floor_int((x - left + 1) / pitch);
    if (i >= 0 && i < letters) {
      squared =
          distance_to_letter(sign.text[static_cast<std::size_t>(i)], x - left - pitch * static_cast<double>(i), y - 0.5 * (board_y - 6));
    }
  }
  if (sign.upright) {  // a tube round the board
    const double inset = 0.55, ex = min_of(x, board_x - x) - inset, ey = min_of(y, board_y - y) - inset;
    squared = min_of(squared, square(min_of(ex, ey)) * 1.6);
  }
  const double core = 1 - smooth_step(0.05, 0.17, squared);
  const double glow = 0.11 / (1 + square(squared * 0.9)) + 0.022 / (1 + 0.12 * squared * squared);
  const double white = 0.28 * core * core;  // the centre of a tube is overexposed toward white
  const Vec burnt{sign.colour.x + white * 4, sign.colour.y + white * 4, sign.colour.z + white * 4};
  const Vec sharp = core * burnt + glow * sign.colour;
  return sign.brightness * mix(sharp, 0.26 * sign.colour, soft);
}

}  // namespace rainref::night_street
