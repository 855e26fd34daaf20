#include "puddle/rainfall.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/number_text.h"
#include "image/texture.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::puddle {
namespace {

constexpr std::size_t most_roofs = 64;
constexpr double farthest_roof = 1e4;  // [m]
constexpr int most_shelter_texels = 8192;

ShelterCell open(double share) { return {static_cast<std::uint32_t>(std::clamp(share, 0.0, 1.0) * 65536 + 0.5)}; }
/// Share of [from, to] that lies in [low, high].
double covered(double from, double to, double low, double high) {
  return std::max(std::min(to, high) - std::max(from, low), 0.0) / (to - from);
}

}  // namespace

std::vector<Roof> parse_roofs(std::string_view text) {
  std::vector<Roof> roofs;
  for (const std::string_view row : scene::split(text, ';')) {
    if (row.empty()) continue;
    const auto fail = [&] {
      throw Error(ExitCode::usage,
                  fmt::format("rain.shelter, roof {}: expected \"x0 z0 x1 z1\", the lower corner first, numbers of at most "
                              "{:g} m, and at most {} roofs; found '{}'",
                              roofs.size() + 1, farthest_roof, most_roofs, row));
    };
    double at[4];
    const std::vector<std::string_view> words = scene::words_of(row);
    if (words.size() != 4 || roofs.size() == most_roofs) fail();
    for (std::size_t k = 0; k < 4; ++k) {
      at[k] = number_from<double>(words[k]).value_or(2 * farthest_roof);
      if (!(std::abs(at[k]) <= farthest_roof)) fail();
    }
    if (!(at[0] < at[2] && at[1] < at[3])) fail();
    roofs.push_back({at[0], at[1], at[2], at[3]});
  }
  return roofs;
}

Shelter shelter_of(const Settings& s, const Image& picture) {
  const std::vector<Roof> roofs = parse_roofs(s.shelter);
  Shelter shelter;
  if (!picture.empty()) {
    if (!roofs.empty()) throw Error(ExitCode::usage, "rain.shelter: expected none beside rain.shelter_image");
    if (std::max(picture.width(), picture.height()) > most_shelter_texels)
      throw Error(ExitCode::usage, fmt::format("rain.shelter_image: expected at most {0}x{0} texels, found {1}x{2}", most_shelter_texels,
                                               picture.width(), picture.height()));
    const TextureData texels(picture, Address::clamp, Address::clamp);
    const Texture& t = texels.view();
    shelter = {picture.width(), picture.height(), {}};
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(shelter.columns) * shelter.rows; ++k)
      shelter.cells.push_back(open(t.texels[t.channels * k]));
  } else if (!roofs.empty()) {
    shelter = {s.grid[0], s.grid[1], {}};
    for (int row = 0; row < shelter.rows; ++row) {
      for (int column = 0; column < shelter.columns; ++column) {
        double share = 1;
        const double x = (column - 0.5 * shelter.columns) * s.cell_size, z = (row - 0.5 * shelter.rows) * s.cell_size;
        for (const Roof& r : roofs) share -= covered(x, x + s.cell_size, r.x0, r.x1) * covered(z, z + s.cell_size, r.z0, r.z1);
        shelter.cells.push_back(open(share));
      }
    }
  }
  return shelter;
}

}  // namespace rainref::puddle
